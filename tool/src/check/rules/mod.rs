//! What a configuration has to be like, one concern to a file.

mod angular_units;
mod bits;
mod comments;
mod external_offsets;
mod files;
mod filters;
mod folders;
mod frame_nets;
mod frame_settings;
mod guard;
mod ini_numbers;
mod inner_kinematics;
mod joint_limits;
mod kinematics;
mod left_behind;
mod limits;
mod linear_units;
mod loaded_modules;
mod modules;
mod motion_numbers;
mod panel;
mod planner;
mod planner_module;
mod previews;
mod remap_files;
mod remaps;
mod screens;
mod sections;
mod subroutines;
mod table;
mod threads;
mod tool_axis;

use super::finding::Findings;
use crate::wiring::installed::LinuxCnc;
use crate::wiring::subject::Subject;

/// Says why the arguments of a `framepath` in `[FILTER]` would be refused.
pub type FilterCheck<'a> = &'a dyn Fn(&[String]) -> Result<(), String>;

/// Looks at everything; `linuxcnc` is the one that would run the machine, if it is here.
pub fn apply(subject: &Subject, filter: FilterCheck, linuxcnc: Option<&LinuxCnc>) -> Findings {
    let mut findings = Findings::default();
    comments::look(subject, &mut findings);
    sections::look(subject, &mut findings);
    if !sections::is_current(subject) {
        // update_ini writes INI and HAL files anew.
        return findings;
    }
    files::look(subject, &mut findings);
    planner_module::look(subject, &mut findings);
    modules::look(subject, linuxcnc, &mut findings);
    loaded_modules::look(subject, linuxcnc, &mut findings);
    bits::look(subject, &mut findings);
    motion_numbers::look(subject, &mut findings);
    ini_numbers::look(subject, &mut findings);
    kinematics::look(subject, &mut findings);
    if subject.has_planner() {
        planner::look(subject, &mut findings);
        joint_limits::look(subject, &mut findings);
        tool_axis::look(subject, &mut findings);
    }
    if subject.has_planner() || subject.has_frames() {
        threads::look(subject, &mut findings);
        linear_units::look(subject, &mut findings);
        angular_units::look(subject, &mut findings);
    }
    if subject.has_frames() {
        frame_nets::look(subject, &mut findings);
        external_offsets::look(subject, linuxcnc, &mut findings);
        table::look(subject, &mut findings);
        guard::look(subject, &mut findings);
        subroutines::look(subject, &mut findings);
        remaps::look(subject, &mut findings);
        previews::look(subject, &mut findings);
        screens::look(subject, &mut findings);
    } else {
        left_behind::look(subject, &mut findings);
    }
    remap_files::look(subject, &mut findings);
    panel::look(subject, &mut findings);
    frame_settings::look(subject, &mut findings);
    limits::look(subject, &mut findings);
    filters::look(subject, filter, &mut findings);
    folders::look(subject, &mut findings);
    findings
}
