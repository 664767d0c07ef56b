//! The sources of the firmware, and building them with cargo.

use super::board::Board;
use super::child::{self, Ended};
use super::job::Goal;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use std::env;
use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

/// octray's sources, and the folder for build results. Only one process at a time holds it, because programs are built
/// one after another under the same name.
#[derive(Debug)]
pub struct SourceTree {
    root: PathBuf,
    built: PathBuf,
    _lock: File,
}

/// The versions of the sources and the compiler.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Versions {
    /// The sources' commit, marked if the sources have been changed since.
    pub commit: String,
    /// The compiler.
    pub toolchain: String,
}

/// A program to build.
#[derive(Clone, Debug)]
pub struct Program<'a> {
    /// The package.
    pub package: &'a str,
    /// Further arguments for cargo: profile, target, features.
    pub arguments: &'a [&'a str],
    /// Variables for the build script.
    pub variables: &'a [(&'a str, &'a str)],
    /// The binary or library of the package.
    pub artifact: &'a str,
}

/// The timeout of a build.
const PATIENCE: Duration = Duration::from_secs(1800);

impl SourceTree {
    /// Returns the folder of octray's sources, from which this program was compiled.
    ///
    /// # Errors
    /// If it does not exist any more.
    pub fn root() -> Result<PathBuf, Error> {
        let host = Path::new(env!("CARGO_MANIFEST_DIR"));
        host.parent()
            .filter(|root| root.join("firmware-sim/Cargo.toml").is_file())
            .map(Path::to_owned)
            .ok_or_else(|| {
                let host = host.display();
                Error::Failed(format!("octray's sources are missing: they were in {host}"))
            })
    }

    /// Waits until no other process builds in it.
    ///
    /// # Errors
    /// If the folder for build results cannot be made.
    pub fn open(root: PathBuf) -> Result<Self, Error> {
        let target =
            env::var_os("CARGO_TARGET_DIR").map_or_else(|| root.join("target"), Into::into);
        let built = target.join("measure");
        let path = built.join(".lock");
        let lock = fs::create_dir_all(&built)
            .and_then(|()| File::create(&path))
            .and_then(|file| file.lock().map(|()| file))
            .map_err(|cause| Error::write(&path, cause))?;
        // Commands run in the folder of the sources.
        let built = fs::canonicalize(&built).map_err(|cause| Error::write(&built, cause))?;
        Ok(Self {
            root,
            built,
            _lock: lock,
        })
    }

    /// Returns the path of a file of the sources.
    pub fn path(&self, name: &str) -> PathBuf {
        self.root.join(name)
    }

    /// Builds a program. Returns its file, or the compiler's complaint.
    ///
    /// # Errors
    /// [`Error::Interrupted`]; [`Error::Failed`] if cargo does not run.
    pub fn build(
        &self,
        program: &Program<'_>,
        interrupt: &Interrupt,
    ) -> Result<Result<PathBuf, String>, Error> {
        let mut command = Command::new("cargo");
        command
            .current_dir(&self.root)
            .args(["build", "--quiet", "--package", program.package])
            .args(["--message-format", "json-render-diagnostics"])
            .arg("--target-dir")
            .arg(&self.built)
            .args(program.arguments);
        // Without the user's settings for other programs.
        for (name, _) in env::vars_os() {
            let text = name.to_string_lossy();
            if text.starts_with("OCTRAY_") || text.ends_with("RUSTFLAGS") {
                command.env_remove(&name);
            }
        }
        command.env_remove("CARGO_BUILD_TARGET");
        command.envs(program.variables.iter().copied());
        let (ended, output) = child::run(command, PATIENCE, interrupt)?;
        if ended != (Ended::Exited { code: 0 }) {
            return Ok(Err(complaint(&output.stderr)));
        }
        artifact(&output.stdout, program.artifact)
            .map(Ok)
            .ok_or_else(|| {
                Error::Failed(format!(
                    "cargo did not report where {} is",
                    program.artifact
                ))
            })
    }

    /// Builds one of the firmware's programs for a board: a binary, and the feature that it needs, if any.
    ///
    /// # Errors
    /// Those of [`Self::build`].
    pub fn firmware(
        &self,
        (binary, feature): (&str, Option<&str>),
        board: &Board,
        goal: Goal,
        variables: &[(&str, &str)],
        interrupt: &Interrupt,
    ) -> Result<Result<PathBuf, String>, Error> {
        let mut arguments = vec!["--bin", binary, "--profile", goal.profile()];
        arguments.extend(["--target", board.target]);
        arguments.extend(feature.iter().flat_map(|feature| ["--features", feature]));
        let mut variables = variables.to_vec();
        // Arm's boards have the same memory layout, so their programs are the same.
        if !board.is_arm() {
            variables.push(("OCTRAY_BOARD", board.machine));
        }
        let program = Program {
            package: "octray-firmware-sim",
            arguments: &arguments,
            variables: &variables,
            artifact: binary,
        };
        self.build(&program, interrupt)
    }

    /// Returns the versions of sources and compiler.
    pub fn versions(&self) -> Versions {
        let says = |program: &str, arguments: &[&str]| {
            Command::new(program)
                .current_dir(&self.root)
                .args(arguments)
                .output()
                .ok()
                .filter(|output| output.status.success())
                .map(|output| String::from_utf8_lossy(&output.stdout).trim().to_owned())
        };
        let commit = says("git", &["rev-parse", "--short=12", "HEAD"]).map(|commit| {
            match says("git", &["status", "--porcelain", "--untracked-files=no"]).as_deref() {
                Some("") => commit,
                _ => format!("{commit}+changes"),
            }
        });
        Versions {
            commit: commit.unwrap_or_else(|| "unknown".into()),
            toolchain: says("rustc", &["--version"]).unwrap_or_else(|| "unknown".into()),
        }
    }
}

/// Returns the last file that cargo reports for the artifact.
fn artifact(messages: &str, name: &str) -> Option<PathBuf> {
    let files = |line: &str| -> Option<PathBuf> {
        let message: serde_json::Value = serde_json::from_str(line).ok()?;
        if message.get("reason")? != "compiler-artifact" || message["target"]["name"] != name {
            return None;
        }
        let file = match message["executable"].as_str() {
            Some(file) => file,
            // Of a package's libraries, the one that other programs load.
            None => (message["filenames"].as_array()?.iter())
                .filter_map(serde_json::Value::as_str)
                .find(|file| file.ends_with(env::consts::DLL_SUFFIX))?,
        };
        Some(file.into())
    };
    messages.lines().rev().find_map(files)
}

/// Returns the most important line of a compiler's complaint: that the program is too large, or else the first error.
fn complaint(text: &str) -> String {
    let line = |what: &str| {
        text.lines()
            .find_map(|line| line.find(what).map(|at| line[at..].trim().to_owned()))
    };
    line("section '")
        .or_else(|| line("error: "))
        .unwrap_or_else(|| text.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_is_found_in_cargos_messages() {
        let library = format!("liboctray_count{}", env::consts::DLL_SUFFIX);
        let messages = format!(
            "{}\n{}\n{}\n",
            r#"{"reason":"compiler-artifact","target":{"name":"fixed"},"filenames":["x"],"executable":null}"#,
            r#"{"reason":"compiler-artifact","target":{"name":"octray-firmware"},"filenames":["a"],"executable":"a"}"#,
            format_args!(
                r#"{{"reason":"compiler-artifact","target":{{"name":"octray_count"}},"filenames":["b.rlib","{library}"],"executable":null}}"#
            ),
        );
        let found = |name| artifact(&messages, name);
        assert_eq!(found("octray-firmware"), Some("a".into()));
        assert_eq!(found("octray_count"), Some(library.into()));
        assert_eq!(found("fixed"), None);
    }

    #[test]
    fn a_complaint_is_a_single_line() {
        let text = "error: linking with `rust-lld` failed: exit status: 1\n  = note: rust-lld: error: \
            section '.text' will not fit in region 'FLASH': overflowed by 512 bytes\n";
        assert_eq!(
            complaint(text),
            "section '.text' will not fit in region 'FLASH': overflowed by 512 bytes"
        );
        assert_eq!(complaint("warning: x\nerror: bad\n more"), "error: bad");
        assert_eq!(complaint("strange\n"), "strange");
    }
}
