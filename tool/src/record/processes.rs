//! Processes beside this one.

use std::path::Path;

/// The name of a process.
fn name_of(folder: &Path) -> Option<String> {
    let name = std::fs::read_to_string(folder.join("comm")).ok()?;
    Some(name.trim_end().to_owned())
}

/// The users (their numbers) who have started what runs threads of a LinuxCNC, one for each process, as far as the
/// operating system tells.
fn real_time() -> Vec<u32> {
    let entries = std::fs::read_dir("/proc").into_iter().flatten().flatten();
    let of_linuxcnc = |folder: &Path| name_of(folder).is_some_and(|name| name == "rtapi_app");
    entries
        .map(|entry| entry.path())
        .filter(|folder| of_linuxcnc(folder))
        .filter_map(|folder| {
            let status = std::fs::read_to_string(folder.join("status")).ok()?;
            starter(&status)
        })
        .collect()
}

/// `Uid: real effective saved of-files`: a rtapi_app that may do what root may has the user who has started it as the
/// saved one.
fn starter(status: &str) -> Option<u32> {
    let users = status.lines().find_map(|line| line.strip_prefix("Uid:"))?;
    users.split_whitespace().nth(2)?.parse().ok()
}

/// Whether a process is one of ours.
pub fn is_framepath(process: u32) -> bool {
    let name = name_of(&Path::new("/proc").join(process.to_string()));
    name.is_some_and(|name| name == "framepath")
}

/// Number of the user of this process.
fn own_user() -> Option<u32> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    starter(&status)
}

/// How many processes of this user run threads of a LinuxCNC.
pub fn own_real_time() -> usize {
    let own = own_user();
    let users = real_time().into_iter();
    users.filter(|user| Some(*user) == own).count()
}

/// Another user who has started a LinuxCNC, and this one, who has not.
pub fn other_user() -> Option<(u32, u32)> {
    let (users, own) = (real_time(), own_user()?);
    let theirs = *users.first()?;
    (!users.contains(&own)).then_some((theirs, own))
}

/// Asks a process to end, as `kill` does; one that is not there any more has.
#[cfg(unix)]
pub fn end(process: i32) {
    if let Some(process) = rustix::process::Pid::from_raw(process) {
        let _ = rustix::process::kill_process(process, rustix::process::Signal::TERM);
    }
}

/// Asks a process to end: LinuxCNC runs on Unix only.
#[cfg(not(unix))]
pub fn end(_process: i32) {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_user_is_the_one_who_has_started_it() {
        let status = "Name:\trtapi_app\nUid:\t0\t0\t1000\t1000\nGid:\t1000\t1000\t1000\t1000\n";
        assert_eq!(starter(status), Some(1000));
        assert_eq!(starter("Name:\trtapi_app\n"), None);
    }
}
