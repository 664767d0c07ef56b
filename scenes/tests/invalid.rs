//! Every mistake in `invalid/` is reported as recorded in the file beside it. After a change of the texts, run with
//! `SNAPSHOTS=overwrite` and read the difference.

use octray_scenes::{ReadError, read};
use snapbox::{Data, assert_data_eq};
use std::path::Path;

#[test]
fn mistakes_are_drawn_as_recorded() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("invalid");
    let mut seen = 0;
    for entry in std::fs::read_dir(&folder).unwrap() {
        let path = entry.unwrap().path();
        if path
            .extension()
            .is_none_or(|extension| extension != "scene")
        {
            continue;
        }
        let error = read(&path).expect_err(&path.display().to_string());
        let drawn = error
            .to_string()
            .replace(&*folder.to_string_lossy(), "invalid");
        let expected = Data::read_from(&path.with_extension("stderr"), None).raw();
        assert_data_eq!(format!("{drawn}\n"), expected);
        seen += 1;
    }
    assert!(seen >= 40, "only {seen} files");
}

#[test]
fn a_binary_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("picture.scene");

    assert!(matches!(read(&path), Err(ReadError::NotFound { .. })));
    assert!(matches!(
        read(folder.path()),
        Err(ReadError::NotAFile { .. })
    ));

    std::fs::write(&path, b"\x89PNG\r\n\x1a\n").unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(
        error.contains("picture.scene:1:1: error: not a text file"),
        "{error}"
    );

    std::fs::write(&path, b"\xff\xfev\0 \x001\0").unwrap();
    let error = read(&path).unwrap_err().to_string();
    assert!(error.contains("UTF-16"), "{error}");
    std::fs::write(path.join("below"), "").unwrap_err();
    assert!(matches!(
        read(path.join("below")),
        Err(ReadError::Unreadable { .. })
    ));
}

#[cfg(unix)]
#[test]
fn a_file_without_permission_is_unreadable() {
    use std::os::unix::fs::PermissionsExt;
    let file = tempfile::NamedTempFile::new().unwrap();
    let no_permissions = std::fs::Permissions::from_mode(0o000);
    std::fs::set_permissions(file.path(), no_permissions).unwrap();
    if std::fs::File::open(file.path()).is_ok() {
        return; // Root may read everything.
    }
    let error = read(file.path()).unwrap_err();
    assert!(matches!(error, ReadError::Unreadable { .. }), "{error}");
}

#[cfg(unix)]
#[test]
fn a_path_through_a_file_is_unreadable() {
    let file = tempfile::NamedTempFile::new().unwrap();
    let error = read(file.path().join("below")).unwrap_err();
    assert!(matches!(error, ReadError::Unreadable { .. }), "{error}");
}

#[cfg(unix)]
#[test]
fn a_device_is_not_a_file() {
    assert!(matches!(read("/dev/zero"), Err(ReadError::NotAFile { .. })));
}
