//! Writing whole files or nothing: a temporary file in the same folder, renamed once complete.

mod temporary;

use crate::error::Error;
use crate::interrupt::Interrupt;
use std::fs::{self, File, OpenOptions};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use temporary::Temporary;

pub use temporary::discard_all as discard_temporaries;

const BUFFER: usize = 1 << 16;

/// As many symbolic links lead on from each other at most.
const MOST_LINKS: usize = 40;

/// Write the file `path` by calling `fill` with where to write.
///
/// A regular file appears (or is replaced, keeping its permissions) only once `fill` has ended well; until then, and
/// after any failure or interrupt, `path` is as it was. A symbolic link is followed, also to a file that does not exist
/// yet. What is no regular file (a device, a pipe) is written directly, and [standard output](is_stdout) too.
///
/// # Errors
/// [`Error::Write`] naming `path` and the cause, [`Error::Interrupted`] when asked to stop meanwhile; for standard
/// output those of [`write_stdout`].
pub fn write_file(
    path: &Path,
    interrupt: &Interrupt,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    if is_stdout(path) {
        return write_stdout(interrupt, fill);
    }
    let write = || -> io::Result<()> {
        match Sink::open(path)? {
            Sink::Device(file) => through(file, interrupt, fill),
            Sink::Regular { temporary, target } => {
                if let Some(file) = temporary.file() {
                    through(file, interrupt, fill)?;
                }
                stop_if(interrupt)?;
                temporary.persist(&target)
            }
        }
    };
    write().map_err(|source| match interrupt.requested() {
        true => Error::Interrupted,
        false => Error::write(path, source),
    })
}

/// Find out before long work whether `path` could be written, leaving no trace but for temporary files of killed
/// processes in its folder, which are removed. Devices and pipes are not touched, for a reader of theirs might notice.
///
/// # Errors
/// [`Error::Write`] as [`write_file`] would give it.
pub fn probe(path: &Path) -> Result<(), Error> {
    if is_stdout(path) || fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir())
    {
        return Ok(());
    }
    let probe = || -> io::Result<()> {
        if let Sink::Regular { target, .. } = Sink::open(path)? {
            temporary::remove_stale(folder_of(&target));
        }
        Ok(())
    };
    probe().map_err(|source| Error::write(path, source))
}

/// Whether a result of this name goes to standard output: `-`, or a name that the system has for it.
pub fn is_stdout(path: &Path) -> bool {
    let names = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
    names.iter().any(|name| path.as_os_str() == *name)
}

/// The file that `path` is, symbolic links followed, also where they lead to a file that does not exist yet.
///
/// # Errors
/// If links lead to each other, or something on the way cannot be looked at.
pub fn target_of(path: &Path) -> io::Result<PathBuf> {
    match fs::metadata(path) {
        Ok(found) if found.is_file() => return path.canonicalize(),
        Ok(_) => return Ok(path.to_owned()),
        Err(error) if error.kind() != io::ErrorKind::NotFound => return Err(error),
        Err(_) => {}
    }
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::read_link(&path) {
            Ok(next) => path = folder_of(&path).join(next),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Write to standard output by calling `fill`.
///
/// # Errors
/// [`Error::BrokenPipe`] when the reader has gone, [`Error::Stdout`] for any other failure,
/// [`Error::Interrupted`] when asked to stop meanwhile.
pub fn write_stdout(
    interrupt: &Interrupt,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    through(io::stdout().lock(), interrupt, fill).map_err(|source| match source.kind() {
        _ if interrupt.requested() => Error::Interrupted,
        io::ErrorKind::BrokenPipe => Error::BrokenPipe,
        _ => Error::Stdout(source),
    })
}

/// Write a report by calling `fill`: to standard output, or to standard error if a result goes to standard output.
///
/// # Errors
/// As [`write_stdout`].
pub fn write_report<'a>(
    results: impl IntoIterator<Item = &'a PathBuf>,
    interrupt: &Interrupt,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), Error> {
    match results.into_iter().any(|path| is_stdout(path)) {
        true => through(io::stderr().lock(), interrupt, fill).map_err(Error::Stdout),
        false => write_stdout(interrupt, fill),
    }
}

/// Where the bytes of a file go.
enum Sink {
    /// Beside the target, under another name.
    Regular {
        temporary: Temporary,
        target: PathBuf,
    },
    /// Into what is there already.
    Device(File),
}

impl Sink {
    fn open(path: &Path) -> io::Result<Self> {
        let target = target_of(path)?;
        let permissions = match fs::metadata(&target) {
            Ok(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if found.is_file() => {
                // Refuse what the user has protected: a rename would not.
                OpenOptions::new().write(true).open(path)?;
                Some(found.permissions())
            }
            Ok(_) => return OpenOptions::new().write(true).open(path).map(Self::Device),
            Err(_) => None,
        };
        let temporary = Temporary::new(folder_of(&target), permissions)?;
        Ok(Self::Regular { temporary, target })
    }
}

/// The folder that holds a file of this name.
fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Let `fill` write into `inner` through a buffer that fails once an interrupt is requested.
fn through(
    inner: impl Write,
    interrupt: &Interrupt,
    fill: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut buffer = BufWriter::with_capacity(BUFFER, Polled { inner, interrupt });
    fill(&mut buffer)?;
    buffer.flush()
}

/// A writer that looks for an interrupt before it writes.
struct Polled<'a, W> {
    inner: W,
    interrupt: &'a Interrupt,
}

impl<W: Write> Write for Polled<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        stop_if(self.interrupt)?;
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

/// Not `ErrorKind::Interrupted`: that one makes `write_all` try again.
fn stop_if(interrupt: &Interrupt) -> io::Result<()> {
    if interrupt.requested() {
        Err(io::Error::other("interrupted"))
    } else {
        Ok(())
    }
}

#[cfg(all(test, unix))]
mod tests {
    use super::*;

    fn entries(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }

    #[test]
    fn a_failed_write_leaves_the_old_file_and_nothing_else() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ppm");
        fs::write(&path, "old").unwrap();
        let result = write_file(&path, &Interrupt::new(), |out| {
            out.write_all(&[0; 3 * BUFFER])?;
            Err(io::Error::other("no more"))
        });
        assert_eq!(
            result.unwrap_err().to_string(),
            format!("cannot write {}: no more", path.display())
        );
        assert_eq!(fs::read(&path).unwrap(), b"old");
        assert_eq!(entries(folder.path()), ["a.ppm"]);
    }

    #[test]
    fn an_interrupt_while_writing_leaves_nothing() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.ppm");
        let interrupt = Interrupt::new();
        let result = write_file(&path, &interrupt, |out| {
            interrupt.request();
            out.write_all(b"half")
        });
        assert!(matches!(result, Err(Error::Interrupted)));
        assert!(entries(folder.path()).is_empty());
    }

    #[test]
    fn a_link_to_a_file_stays_a_link_and_a_device_is_written_directly() {
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("file"), folder.path().join("link"));
        fs::write(&file, "old").unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_file(&link, &Interrupt::new(), |out| out.write_all(b"new")).unwrap();
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::read(&file).unwrap(), b"new");
        write_file(Path::new("/dev/null"), &Interrupt::new(), |out| {
            out.write_all(b"gone")
        })
        .unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());
    }

    #[test]
    fn a_link_to_no_file_yet_is_followed_and_a_loop_refused() {
        use std::os::unix::fs::symlink;
        let folder = tempfile::tempdir().unwrap();
        let name = |name: &str| folder.path().join(name);
        fs::create_dir(name("deep")).unwrap();
        symlink("deep/second", name("first")).unwrap();
        symlink("../file", name("deep/second")).unwrap();
        write_file(&name("first"), &Interrupt::new(), |out| {
            out.write_all(b"new")
        })
        .unwrap();
        assert_eq!(fs::read(name("file")).unwrap(), b"new");
        assert_eq!(
            target_of(&name("first")).unwrap(),
            name("file").canonicalize().unwrap()
        );

        symlink("loop", name("loop")).unwrap();
        symlink("no/file", name("nowhere")).unwrap();
        for link in ["loop", "nowhere"] {
            let write = |out: &mut dyn Write| out.write_all(b"new");
            write_file(&name(link), &Interrupt::new(), write).unwrap_err();
            probe(&name(link)).unwrap_err();
            assert!(fs::symlink_metadata(name(link)).unwrap().is_symlink());
        }
        assert_eq!(
            entries(folder.path()),
            ["deep", "file", "first", "loop", "nowhere"]
        );
    }

    #[test]
    fn what_a_killed_process_left_is_removed_and_what_is_being_written_stays() {
        let folder = tempfile::tempdir().unwrap();
        for name in [".octray-killed.part", ".octray-settings", "other.part"] {
            fs::write(folder.path().join(name), "half").unwrap();
        }
        let live = Temporary::new(folder.path(), None).unwrap();
        probe(&folder.path().join("a.png")).unwrap();
        assert_eq!(
            entries(folder.path()).len(),
            3,
            "{:?}",
            entries(folder.path())
        );
        assert!(!folder.path().join(".octray-killed.part").exists());
        live.persist(&folder.path().join("whole")).unwrap();
        assert_eq!(
            entries(folder.path()),
            [".octray-settings", "other.part", "whole"]
        );
    }

    #[test]
    fn a_replaced_file_keeps_its_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.png");
        fs::write(&path, "old").unwrap();
        for mode in [0o600, 0o664, 0o777] {
            fs::set_permissions(&path, fs::Permissions::from_mode(mode)).unwrap();
            write_file(&path, &Interrupt::new(), |out| out.write_all(b"new")).unwrap();
            let found = fs::metadata(&path).unwrap().permissions().mode();
            assert_eq!(found & 0o777, mode);
        }
    }

    #[test]
    fn a_full_device_is_told() {
        let full = Path::new("/dev/full");
        if full.exists() {
            let result = write_file(full, &Interrupt::new(), |out| out.write_all(b"x"));
            let text = result.unwrap_err().to_string();
            assert!(
                text.starts_with("cannot write /dev/full: No space left"),
                "{text}"
            );
        }
    }

    #[test]
    fn a_probe_leaves_no_trace_and_finds_a_missing_folder() {
        let folder = tempfile::tempdir().unwrap();
        probe(&folder.path().join("a.png")).unwrap();
        assert!(entries(folder.path()).is_empty());
        let text = probe(&folder.path().join("no/a.png"))
            .unwrap_err()
            .to_string();
        assert!(
            text.contains("no/a.png") && !text.contains(".octray-"),
            "{text}"
        );
    }

    #[test]
    fn a_new_file_has_the_usual_permissions() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (ours, plain) = (folder.path().join("ours"), folder.path().join("plain"));
        write_file(&ours, &Interrupt::new(), |out| out.write_all(b"x")).unwrap();
        fs::write(&plain, "x").unwrap();
        let mode = |path| fs::metadata(path).unwrap().permissions().mode();
        assert_eq!(mode(&ours), mode(&plain));
    }
}
