//! Temporary files beside those that they become.
//!
//! Each is locked as long as its process lives, so that what a killed process left is told from what another one still
//! writes. A process that is to end at once [discards](discard_all) its own.

use std::fs::{self, File, OpenOptions, Permissions};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tempfile::NamedTempFile;

const PREFIX: &str = ".octray-";
const SUFFIX: &str = ".part";

/// Those of this process.
static LIVE: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

/// A temporary file, removed when dropped.
pub(super) struct Temporary {
    /// `None` once it has its final name.
    made: Option<NamedTempFile>,
    path: PathBuf,
}

impl Temporary {
    /// Makes one in a folder, with these permissions or the usual ones.
    pub(super) fn new(folder: &Path, permissions: Option<Permissions>) -> io::Result<Self> {
        loop {
            // Opened by std, so that the permissions are the usual ones and an error names no temporary file.
            let create = |path: &Path| {
                let file = options(permissions.as_ref()).open(path)?;
                live(|all| all.push(path.to_owned()));
                Ok(file)
            };
            let made = tempfile::Builder::new()
                .prefix(PREFIX)
                .suffix(SUFFIX)
                .make_in(folder, create)?;
            // Some file systems know no locks; there nothing is ever removed as stale. Whoever removes stale files may
            // have been faster than the lock.
            let _ = made.as_file().try_lock();
            let path = made.path().to_owned();
            let made = Self {
                made: Some(made),
                path,
            };
            if made.path.try_exists().unwrap_or(true) {
                if let Some(permissions) = permissions {
                    fs::set_permissions(&made.path, permissions)?;
                }
                return Ok(made);
            }
        }
    }

    /// Where to write. Not the temporary file itself, whose errors name it.
    pub(super) fn file(&self) -> Option<&File> {
        self.made.as_ref().map(NamedTempFile::as_file)
    }

    /// Gives it its final name, replacing what has it.
    pub(super) fn persist(mut self, target: &Path) -> io::Result<()> {
        live(|_| match self.made.take() {
            Some(made) => made
                .persist(target)
                .map_err(|failed| failed.error)
                .map(drop),
            None => Ok(()),
        })
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        live(|all| {
            drop(self.made.take());
            all.retain(|path| *path != self.path);
        });
    }
}

/// Removes the temporary files of this process, and lets it make no more: it is about to end.
pub fn discard_all() {
    let all = LIVE.lock().unwrap_or_else(PoisonError::into_inner);
    for path in &*all {
        // It may just have got its final name.
        let _ = fs::remove_file(path);
    }
    std::mem::forget(all);
}

/// Removes what killed processes left in a folder. What cannot be removed stays.
pub(super) fn remove_stale(folder: &Path) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for entry in entries {
        let name = entry.file_name();
        let name = name.to_string_lossy();
        let ours = name.starts_with(PREFIX) && name.ends_with(SUFFIX);
        if !ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        let file = OpenOptions::new().write(true).open(entry.path());
        if file.is_ok_and(|file| file.try_lock().is_ok()) {
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn live<R>(change: impl FnOnce(&mut Vec<PathBuf>) -> R) -> R {
    change(&mut LIVE.lock().unwrap_or_else(PoisonError::into_inner))
}

/// How to create a file that is at no time open to more users than it will be.
#[cfg_attr(not(unix), expect(unused_variables))]
fn options(permissions: Option<&Permissions>) -> OpenOptions {
    let mut options = OpenOptions::new();
    options.write(true).create_new(true);
    #[cfg(unix)]
    if let Some(permissions) = permissions {
        use std::os::unix::fs::{OpenOptionsExt, PermissionsExt};
        options.mode(permissions.mode() & 0o777);
    }
    options
}
