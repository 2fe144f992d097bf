//! With the feature `linuxcnc`: what the edge to LinuxCNC needs of its headers.

#[cfg(feature = "linuxcnc")]
#[path = "build/linuxcnc.rs"]
mod linuxcnc;

fn main() {
    println!("cargo:rerun-if-changed=build");
    #[cfg(feature = "linuxcnc")]
    linuxcnc::build();
}
