//! The modules of others that HAL files load: that LinuxCNC has them.

use crate::check::finding::{Findings, advice};
use crate::wiring::installed::LinuxCnc;
use crate::wiring::subject::Subject;

/// Looks at all that are not framepath's; without a LinuxCNC here there is nothing to be looked at.
pub fn look(subject: &Subject, linuxcnc: Option<&LinuxCnc>, findings: &mut Findings) {
    // Where the folder does not even have motion, modules are elsewhere: in the kernel, or not installed.
    let Some(linuxcnc) = linuxcnc.filter(|linuxcnc| linuxcnc.module("motmod").exists()) else {
        return;
    };
    let loaded = subject.state.modules.iter();
    let of_others =
        loaded.filter(|module| !matches!(module.name.as_str(), "blendtp" | "framekins"));
    for module in of_others {
        let file = linuxcnc.module(&module.name);
        if module.name.is_empty() || file.exists() {
            continue;
        }
        let found = format!(
            "LinuxCNC has no module {}, and loadrt fails: {} is not there",
            module.name,
            file.display()
        );
        let remedy = "correct the name, or install the module with halcompile --install";
        findings.error(&module.statement.place, found, advice(remedy));
    }
}
