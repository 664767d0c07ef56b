//! Checks of the files that arguments name: no result may replace an input or another result.

use octray_render::error::Error;
use octray_render::output;
use octray_scenes::input;
use octray_scenes::name::Shown;
use std::fs;
use std::path::{Path, PathBuf, absolute};

/// Checks that no two of `results` are the same file, and that none of them is one of `inputs`. Different spellings of
/// a path count as one file: `a.scene`, `./a.scene` and a symbolic link to it. Devices and pipes may be named
/// repeatedly, because writing to them replaces nothing.
///
/// # Errors
/// [`Error::Usage`], which names the first result that would replace something.
pub fn distinct<I: AsRef<Path>, R: AsRef<Path>>(
    inputs: impl IntoIterator<Item = I>,
    results: impl IntoIterator<Item = R>,
) -> Result<(), Error> {
    let named = |path: &Path| (path.to_owned(), identity(path));
    let inputs: Vec<_> = inputs
        .into_iter()
        .map(|path| named(path.as_ref()))
        .collect();
    let mut before: Vec<(PathBuf, Option<PathBuf>)> = Vec::new();
    for (path, file) in results.into_iter().map(|path| named(path.as_ref())) {
        if output::is_stdout(&path) && before.iter().any(|other| output::is_stdout(&other.0)) {
            return Err(Error::Usage(
                "two results cannot go to standard output: name a file for one of them".into(),
            ));
        }
        let same = |other: &&(PathBuf, Option<PathBuf>)| file.is_some() && other.1 == file;
        let name = Shown(&path);
        if let Some((input, _)) = inputs.iter().find(same) {
            let input = Shown(input);
            return Err(Error::Usage(format!(
                "the result {name} would replace {input}, which is read: name another file"
            )));
        }
        if let Some((result, _)) = before.iter().find(same) {
            let result = Shown(result);
            return Err(Error::Usage(format!(
                "the results {result} and {name} are one file: name another for one of them"
            )));
        }
        before.push((path, file));
    }
    Ok(())
}

/// Returns the name of a result that nobody has named, after the scene that it is made of.
///
/// # Errors
/// [`Error::Usage`] if the scene comes from where files have no names.
pub fn named_after(scene: &Path, end: &str) -> Result<PathBuf, Error> {
    let is_pipe = fs::metadata(scene).is_ok_and(|found| !found.is_file());
    if input::is_stdin(scene) || is_pipe {
        return Err(Error::Usage(format!(
            "'{}' is no file to name the picture after: name it by '-o'",
            Shown(scene)
        )));
    }
    let mut name = scene.file_stem().unwrap_or_default().to_owned();
    name.push(end);
    Ok(name.into())
}

/// Returns the canonical path of the regular file that `path` is or would become, and `None` if something else exists
/// there, or `path` is standard input or output.
fn identity(path: &Path) -> Option<PathBuf> {
    if output::is_stdout(path) {
        return None;
    }
    let target = output::target_of(path);
    let path = target.as_deref().unwrap_or(path);
    if let Ok(found) = fs::metadata(path) {
        return (found.is_file()).then(|| path.canonicalize().unwrap_or_else(|_| path.to_owned()));
    }
    let path = absolute(path).unwrap_or_else(|_| path.to_owned());
    let folder = path.parent().and_then(|folder| folder.canonicalize().ok());
    Some(match (folder, path.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => path,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns the error message for these names, in a folder with a file `a` and a folder `deep`.
    fn message(inputs: &[&str], results: &[&str]) -> Option<String> {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("a"), "").unwrap();
        fs::create_dir(folder.path().join("deep")).unwrap();
        #[cfg(unix)]
        std::os::unix::fs::symlink("a", folder.path().join("link")).unwrap();
        let inside = |names: &[&str]| -> Vec<_> {
            let names = names.iter();
            names.map(|name| folder.path().join(name)).collect()
        };
        let error = distinct(inside(inputs), inside(results)).err()?;
        assert!(matches!(error, Error::Usage(_)));
        Some(error.to_string())
    }

    #[test]
    fn a_file_is_recognised_under_every_spelling() {
        for name in [
            "a",
            "./a",
            "deep/../a",
            #[cfg(unix)]
            "link",
        ] {
            let text = message(&["a"], &["b", name]).unwrap();
            assert!(text.contains("which is read"), "{name}: {text}");
            let text = message(&[], &[name, "a"]).unwrap();
            assert!(text.contains("are one file"), "{name}: {text}");
        }
    }

    #[test]
    fn results_that_do_not_exist_yet_are_distinguished_too() {
        assert!(message(&["a"], &["b", "./b"]).is_some());
        assert!(message(&["a"], &["b", "deep/../b"]).is_some());
        assert!(message(&["a"], &["no/b", "no/./b"]).is_some());
        assert_eq!(message(&["a"], &["b", "c", "deep/a", "no/a"]), None);
    }

    #[test]
    fn reading_a_file_twice_is_no_mistake() {
        assert_eq!(message(&["a", "./a"], &["b"]), None);
    }

    #[cfg(unix)]
    #[test]
    fn devices_may_be_named_twice() {
        let null = ["/dev/null"; 2];
        distinct(null, null).unwrap();
    }
}
