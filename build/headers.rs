// A part of both build scripts.

/// Where Debian's linuxcnc-uspace-dev puts the headers.
const DEFAULT_INCLUDE: &str = "/usr/include/linuxcnc";

/// The folders of LinuxCNC's headers, in one of which this one has to be. Without it the build ends.
fn headers(needed: &str) -> Vec<String> {
    println!("cargo:rerun-if-env-changed=LINUXCNC_INCLUDE");
    let include = env::var("LINUXCNC_INCLUDE").unwrap_or_else(|_| DEFAULT_INCLUDE.to_owned());
    let folders: Vec<String> = include.split(':').map(str::to_owned).collect();
    let has = |folder: &String| Path::new(folder).join(needed).exists();
    if !folders.iter().any(has) {
        eprintln!(
            "error: LinuxCNC's header {needed} is not in {include}\n\
             help: apt-get install linuxcnc-uspace-dev, or name the folders in LINUXCNC_INCLUDE, with colons between; the \
             packages of LinuxCNC 2.10 lack it: make LINUXCNC_SOURCE=..., with the folder of LinuxCNC's own source"
        );
        exit(1);
    }
    for folder in &folders {
        watch(folder);
    }
    folders
}

/// Has this run again for another LinuxCNC: its headers are newer, or `make modules` has noticed that they differ (those
/// of another release may be older than what was built with the last one's).
fn watch(include: &str) {
    println!("cargo:rerun-if-changed={include}");
    let out = PathBuf::from(env::var_os("OUT_DIR").expect("cargo sets OUT_DIR"));
    // OUT_DIR is target/PROFILE/build/PACKAGE/out
    let noticed = out
        .ancestors()
        .nth(4)
        .map(|target| target.join("modules/built-for"));
    if let Some(noticed) = noticed.filter(|file| file.exists()) {
        println!("cargo:rerun-if-changed={}", noticed.display());
    }
}
