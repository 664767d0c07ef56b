//! Whole files, pipes and standard input, read up to a bound: none of them can take all memory or go on for ever.

use std::fs::File;
use std::io::{self, IsTerminal, Read};
use std::path::Path;

/// The most bytes of a scene file.
pub const MOST_SCENE: u64 = 1 << 31;

/// Whether an input of this name is standard input.
pub fn is_stdin(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Reads a file, a pipe or, if the path is `-`, standard input.
///
/// # Errors
/// The system's; [`io::ErrorKind::FileTooLarge`] if it has more than `most` bytes, [`io::ErrorKind::IsADirectory`],
/// and [`io::ErrorKind::InvalidInput`] for a device that is no terminal, as it may never end.
pub fn read(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let (input, size) = open(path)?;
    let too_large = || {
        let text = format!("it has more than {most} bytes");
        io::Error::new(io::ErrorKind::FileTooLarge, text)
    };
    if size > most {
        return Err(too_large());
    }
    let mut bytes = Vec::new();
    bytes.try_reserve_exact(size as usize)?;
    input.take(most + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > most {
        return Err(too_large());
    }
    Ok(bytes)
}

/// Reads a file as [`read`] does, and takes it for UTF-8 or, if it is not, for Latin-1: in what has a meaning the two do
/// not differ.
///
/// # Errors
/// Those of [`read`]; [`io::ErrorKind::InvalidData`] for UTF-16.
pub fn read_text(path: &Path, most: u64) -> io::Result<String> {
    text(read(path, most)?)
}

/// Opens an input that is read as it comes, with the bounds of kind that [`read`] has.
///
/// # Errors
/// As [`read`], but for the size.
pub fn stream(path: &Path) -> io::Result<Box<dyn Read>> {
    Ok(open(path)?.0)
}

/// Returns an input and, if it is a regular file, its size.
fn open(path: &Path) -> io::Result<(Box<dyn Read>, u64)> {
    if is_stdin(path) {
        #[cfg(unix)]
        {
            let stdin = Path::new("/dev/stdin");
            // A closed standard input has no file, but reads as empty.
            if stdin.try_exists().unwrap_or(false) {
                bounded(stdin.metadata()?, || io::stdin().is_terminal())?;
            }
        }
        return Ok((Box::new(io::stdin().lock()), 0));
    }
    let file = File::open(path)?;
    let found = file.metadata()?;
    if found.is_dir() {
        return Err(io::ErrorKind::IsADirectory.into());
    }
    let size = if found.is_file() { found.len() } else { 0 };
    bounded(found, || file.is_terminal())?;
    Ok((Box::new(file), size))
}

/// Refuses what may never end: a device, unless somebody types.
fn bounded(found: std::fs::Metadata, is_terminal: impl FnOnce() -> bool) -> io::Result<()> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::FileTypeExt;
        let kind = found.file_type();
        if (kind.is_char_device() || kind.is_block_device()) && !is_terminal() {
            let text = "a device, which may never end";
            return Err(io::Error::new(io::ErrorKind::InvalidInput, text));
        }
    }
    #[cfg(not(unix))]
    let _ = (found, is_terminal);
    Ok(())
}

fn text(bytes: Vec<u8>) -> io::Result<String> {
    if matches!(*bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]) {
        let text = "it is UTF-16, expected UTF-8 or Latin-1";
        return Err(io::Error::new(io::ErrorKind::InvalidData, text));
    }
    Ok(String::from_utf8(bytes).unwrap_or_else(|error| {
        let bytes = error.into_bytes();
        bytes.into_iter().map(char::from).collect()
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_no_utf_8_is_latin_1() {
        assert_eq!(text("# é".into()).unwrap(), "# é");
        assert_eq!(
            text(b"# caf\xe9 \x80\0".to_vec()).unwrap(),
            "# café \u{80}\0"
        );
        text(b"\xff\xfev\0 \0".to_vec()).unwrap_err();
    }

    #[test]
    fn a_file_beyond_the_bound_is_not_read() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("large");
        std::fs::write(&path, [b'x'; 10]).unwrap();
        assert_eq!(read(&path, 10).unwrap().len(), 10);
        assert_eq!(
            read(&path, 9).unwrap_err().kind(),
            io::ErrorKind::FileTooLarge
        );
        // A terabyte of nothing.
        let sparse = File::create(&path).unwrap();
        if sparse.set_len(1 << 40).is_ok() {
            let error = read(&path, MOST_SCENE).unwrap_err();
            assert_eq!(error.kind(), io::ErrorKind::FileTooLarge);
        }
    }

    #[cfg(unix)]
    #[test]
    fn folders_and_devices_are_refused() {
        let kind = |path| read(Path::new(path), 9).unwrap_err().kind();
        assert_eq!(kind("/"), io::ErrorKind::IsADirectory);
        assert_eq!(kind("/dev/zero"), io::ErrorKind::InvalidInput);
        assert_eq!(kind("/nowhere/a"), io::ErrorKind::NotFound);
    }
}
