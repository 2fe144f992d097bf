//! With the feature `linuxcnc`: the programs that run LinuxCNC's interpreter and planner modules.

#[cfg(feature = "linuxcnc")]
#[path = "build/linuxcnc.rs"]
mod linuxcnc;

fn main() {
    println!("cargo:rerun-if-changed=build");
    #[cfg(feature = "linuxcnc")]
    linuxcnc::build();
}
