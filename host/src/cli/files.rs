//! The files that arguments name: no result is written over what is read, or over another result.

use octray_render::error::Error;
use std::fs;
use std::path::{Path, PathBuf, absolute};

/// Make sure that each of `results` is a file of its own, and none of `inputs`, however they are spelled:
/// `a.scene`, `./a.scene` and a symbolic link to it are one file. Devices and pipes may be named for several
/// things at once, for nothing in them is replaced.
///
/// # Errors
/// [`Error::Usage`] naming the first result that would replace something.
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
        let same = |other: &&(PathBuf, Option<PathBuf>)| file.is_some() && other.1 == file;
        let name = path.display();
        if let Some((input, _)) = inputs.iter().find(same) {
            let input = input.display();
            return Err(Error::Usage(format!(
                "the result {name} would replace {input}, which is read: name another file"
            )));
        }
        if let Some((result, _)) = before.iter().find(same) {
            let result = result.display();
            return Err(Error::Usage(format!(
                "the results {result} and {name} are one file: name another for one of them"
            )));
        }
        before.push((path, file));
    }
    Ok(())
}

/// The one name of the regular file that `path` is or would become; `None` for what is there and is none.
fn identity(path: &Path) -> Option<PathBuf> {
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

    /// What is said of them, in a folder with a file `a` and a folder `deep`.
    fn told(inputs: &[&str], results: &[&str]) -> Option<String> {
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
    fn a_file_is_known_under_every_name() {
        for name in [
            "a",
            "./a",
            "deep/../a",
            #[cfg(unix)]
            "link",
        ] {
            let text = told(&["a"], &["b", name]).unwrap();
            assert!(text.contains("which is read"), "{name}: {text}");
            let text = told(&[], &[name, "a"]).unwrap();
            assert!(text.contains("are one file"), "{name}: {text}");
        }
    }

    #[test]
    fn results_that_do_not_exist_yet_are_told_apart_too() {
        assert!(told(&["a"], &["b", "./b"]).is_some());
        assert!(told(&["a"], &["b", "deep/../b"]).is_some());
        assert!(told(&["a"], &["no/b", "no/./b"]).is_some());
        assert_eq!(told(&["a"], &["b", "c", "deep/a", "no/a"]), None);
    }

    #[test]
    fn reading_a_file_twice_is_no_mistake() {
        assert_eq!(told(&["a", "./a"], &["b"]), None);
    }

    #[cfg(unix)]
    #[test]
    fn devices_may_be_named_twice() {
        let null = ["/dev/null"; 2];
        distinct(null, null).unwrap();
    }
}
