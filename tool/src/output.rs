//! Files that the commands write: each is there whole, or as it was before. And what they say beside it.

use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufWriter, Write};
#[cfg(unix)]
use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use tempfile::TempPath;

/// A line on standard error. That nobody can read it changes nothing of what is done.
pub fn tell(text: impl Display) {
    let _ = writeln!(io::stderr(), "{text}");
}

/// The error of a temporary file, with the folder that it was to be in.
pub(crate) fn in_temporary_folder(error: io::Error) -> io::Error {
    let folder = std::env::temp_dir();
    let told = format!(
        "{}: {error}; temporary files go there: set TMPDIR to a folder that is there and has room",
        folder.display()
    );
    io::Error::new(error.kind(), told)
}

/// The first of these files that is named twice; devices take what comes as often as it comes.
#[cfg(feature = "linuxcnc")]
pub(crate) fn named_twice<'a>(files: &[&'a Option<PathBuf>]) -> Option<&'a Path> {
    let mut named = Vec::new();
    for file in files.iter().filter_map(|file| file.as_deref()) {
        let place = place_of(file);
        if named.contains(&place) && !is_device(file) {
            return Some(file);
        }
        named.push(place);
    }
    None
}

/// The first of the files to be written that is one of those that are `read`, whose content would be lost.
pub(crate) fn overwrites<'a>(
    written: impl IntoIterator<Item = &'a Path>,
    read: &[&Path],
) -> Option<&'a Path> {
    let read: Vec<PathBuf> = read.iter().map(|file| place_of(file)).collect();
    written
        .into_iter()
        .find(|file| !is_device(file) && read.contains(&place_of(file)))
}

fn is_device(file: &Path) -> bool {
    file.exists() && !file.is_file()
}

/// "out" and "./out" are the same, and so is a link to it.
fn place_of(file: &Path) -> PathBuf {
    if let Ok(place) = std::fs::canonicalize(file) {
        return place;
    }
    let absolute = std::path::absolute(file).unwrap_or_else(|_| file.to_owned());
    let folder = absolute.parent().map(std::fs::canonicalize);
    match (folder, absolute.file_name()) {
        (Some(Ok(folder)), Some(name)) => folder.join(name),
        _ => absolute,
    }
}

/// A file that takes its place when it is complete: until then it is written beside it, under
/// another name. Dropped without [`Self::finish`] it leaves nothing behind.
///
/// What is no ordinary file (a device, a pipe) is written to as it is: it cannot be replaced.
#[derive(Debug)]
pub(crate) struct OutputFile {
    /// As the user named it, for messages.
    name: PathBuf,
    output: BufWriter<File>,
    /// What is written, and what it becomes; `None` if it is written in place.
    replaces: Option<(TempPath, PathBuf)>,
}

impl OutputFile {
    /// Begins to write a file.
    ///
    /// # Errors
    /// A folder that is missing or may not be written in.
    pub fn create(name: &Path) -> io::Result<OutputFile> {
        // Behind a symbolic link it is the file that is replaced, not the link.
        let place = std::fs::canonicalize(name).unwrap_or_else(|_| name.to_owned());
        let before = std::fs::metadata(&place).ok();
        if before.as_ref().is_some_and(|before| !before.is_file()) {
            return Ok(OutputFile::new(name, File::create(name)?, None));
        }
        let folder = match place.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut builder = tempfile::Builder::new();
        builder.prefix(".framepath-");
        // As for any new file, less the umask; tempfile's own are for secrets.
        #[cfg(unix)]
        builder.permissions(PermissionsExt::from_mode(0o666));
        let file = builder.tempfile_in(folder)?;
        if let Some(before) = before {
            // A file that is protected against writing is not replaced either.
            File::options().write(true).open(&place)?;
            file.as_file().set_permissions(before.permissions())?;
        }
        let (file, path) = file.into_parts();
        Ok(OutputFile::new(name, file, Some((path, place))))
    }

    fn new(name: &Path, file: File, replaces: Option<(TempPath, PathBuf)>) -> OutputFile {
        OutputFile {
            name: name.to_owned(),
            output: BufWriter::with_capacity(1 << 18, file),
            replaces,
        }
    }

    /// As the user named it.
    pub fn name(&self) -> &Path {
        &self.name
    }

    /// Puts the file in its place.
    ///
    /// # Errors
    /// A disk that is full, and the like; the file is then as it was before.
    pub fn finish(mut self) -> io::Result<()> {
        self.output.flush()?;
        match self.replaces {
            Some((path, place)) => path.persist(place).map_err(|error| error.error),
            None => Ok(()),
        }
    }
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.output.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.output.flush()
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::fs::{self, Permissions};
    use std::os::unix::fs::{FileTypeExt, symlink};

    fn names(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).expect("a folder").map(|entry| {
            let name = entry.expect("an entry").file_name();
            name.to_string_lossy().into_owned()
        });
        let mut names: Vec<_> = entries.collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_there_when_it_is_finished_and_not_before() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("plan.csv");
        let mut dropped = OutputFile::create(&place).expect("created");
        dropped.write_all(&[b'x'; 1 << 19]).expect("written");
        assert!(!place.exists());
        drop(dropped);
        assert_eq!(names(folder.path()), Vec::<String>::new());

        let mut whole = OutputFile::create(&place).expect("created");
        whole.write_all(b"whole\n").expect("written");
        whole.finish().expect("finished");
        assert_eq!(names(folder.path()), ["plan.csv"]);
        assert_eq!(fs::read_to_string(&place).expect("text"), "whole\n");
    }

    #[test]
    fn what_was_there_stays_until_then_with_its_permissions() {
        let folder = tempfile::tempdir().expect("a folder");
        let place = folder.path().join("plan.csv");
        fs::write(&place, "before").expect("written");
        fs::set_permissions(&place, Permissions::from_mode(0o640)).expect("set");
        drop(OutputFile::create(&place).expect("created"));
        assert_eq!(fs::read_to_string(&place).expect("text"), "before");

        OutputFile::create(&place)
            .and_then(OutputFile::finish)
            .expect("finished");
        assert_eq!(fs::read_to_string(&place).expect("text"), "");
        let mode = fs::metadata(&place).expect("a file").permissions().mode();
        assert_eq!(mode & 0o777, 0o640);
    }

    /// A new file may be read by whom files may be read that other programs write.
    #[test]
    fn a_new_file_has_the_usual_permissions() {
        let folder = tempfile::tempdir().expect("a folder");
        let mode = |name: &str| {
            let file = fs::metadata(folder.path().join(name)).expect("a file");
            file.permissions().mode()
        };
        fs::write(folder.path().join("usual"), "").expect("written");
        let created = OutputFile::create(&folder.path().join("ours"));
        created.and_then(OutputFile::finish).expect("finished");
        assert_eq!(mode("ours"), mode("usual"));
    }

    #[test]
    fn links_and_devices_stay_what_they_are() {
        let folder = tempfile::tempdir().expect("a folder");
        let (target, link) = (folder.path().join("target"), folder.path().join("link"));
        fs::write(&target, "before").expect("written");
        symlink(&target, &link).expect("a link");
        OutputFile::create(&link)
            .and_then(OutputFile::finish)
            .expect("finished");
        assert!(fs::symlink_metadata(&link).expect("a link").is_symlink());
        assert_eq!(fs::read_to_string(&target).expect("text"), "");

        let device = Path::new("/dev/null");
        let mut written = OutputFile::create(device).expect("opened");
        assert!(written.replaces.is_none());
        written.write_all(b"nothing").expect("written");
        written.finish().expect("finished");
        let kind = fs::metadata(device).expect("a device").file_type();
        assert!(kind.is_char_device());
    }
}
