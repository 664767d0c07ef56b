//! The command end to end: what it prints, what it writes, and its exit codes.

mod common;

use common::{names, octray, pictures};
use snapbox::cmd::cargo_bin;
use snapbox::{assert_data_eq, str};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

mod check {
    use super::*;

    const SCENE: &str = "v 0 0 -9\nl 1 1 1 1\nf 1 1 1 0 0 0 0 0 0 0 0 0\ns 0 0 5 1\n";

    #[test]
    fn prints_the_contents_of_each_scene() {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("a.scene"), SCENE).unwrap();
        octray(folder.path(), "check a.scene a.scene")
            .assert()
            .success()
            .stderr_eq("")
            .stdout_eq(str![[r#"
a.scene: 1 sphere, 1 surface, 1 light, 512 x 512 pixels
a.scene: 1 sphere, 1 surface, 1 light, 512 x 512 pixels

"#]]);
    }

    #[test]
    fn a_bad_scene_does_not_hide_the_others() {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("good.scene"), SCENE).unwrap();
        fs::write(
            folder.path().join("bad.scene"),
            format!("{SCENE}ball 1 2 3"),
        )
        .unwrap();
        octray(folder.path(), "check missing.scene bad.scene good.scene")
            .assert()
            .code(1)
            .stdout_eq(str![[r#"
good.scene: 1 sphere, 1 surface, 1 light, 512 x 512 pixels

"#]])
            .stderr_eq(str![[r#"
error: missing.scene: no such file

bad.scene:5:1: error: [..]`ball`
...
5 | ball 1 2 3
...

"#]]);
    }

    #[test]
    fn without_a_scene_it_is_bad_usage() {
        octray(Path::new("."), "check").assert().code(2);
    }
}

mod generate {
    use super::*;

    #[test]
    fn every_kind_gives_a_readable_scene_with_the_requested_number_of_objects() {
        let folder = TempDir::new().unwrap();
        for (kind, facts) in [
            ("flake", "19 spheres, 1 polygon, [..]"),
            ("lattice", "[..] spheres, [..] cones, 1 polygon, [..]"),
            ("terrain", "19 polygons, [..]"),
            ("tree", "9 spheres, 9 cones, 1 polygon, [..]"),
            ("soup", "[..] patches, [..]"),
        ] {
            let name = format!("{kind}.scene");
            octray(
                folder.path(),
                &format!("generate {kind} --count 20 -o {name}"),
            )
            .assert()
            .success()
            .stdout_eq("")
            .stderr_eq("");
            octray(folder.path(), &format!("check {name}"))
                .assert()
                .success()
                .stdout_eq(format!("{name}: {facts}\n"));
        }
    }

    #[test]
    fn standard_output_equals_the_file_and_the_seed_matters() {
        let folder = TempDir::new().unwrap();
        let made = |line: &str| {
            let output = octray(folder.path(), line).output().unwrap();
            assert!(output.status.success(), "{line}");
            output.stdout
        };
        made("generate soup --count 9 --seed 7 -o a.scene");
        let file = fs::read(folder.path().join("a.scene")).unwrap();
        assert_eq!(made("generate soup --count 9 --seed 7"), file);
        assert_ne!(made("generate soup --count 9 --seed 8"), file);
        assert!(file.starts_with(b"# octray generate soup --count 9 --seed 7\n"));
    }

    #[test]
    fn wrong_values_are_bad_usage() {
        for line in [
            "",
            "forest",
            "soup --count 0",
            "soup --seed -1",
            "soup --count 1e9",
        ] {
            octray(Path::new("."), &format!("generate {line}"))
                .assert()
                .code(2)
                .stdout_eq("");
        }
    }

    #[test]
    fn a_missing_folder_is_reported() {
        octray(Path::new("."), "generate soup -o no/a.scene")
            .assert()
            .code(1)
            .stderr_eq(str![[r#"
error: cannot write no/a.scene: No such file or directory (os error 2)

"#]]);
    }
}

mod results {
    use super::*;

    /// Checks that the command is refused with the message `why`, and that no file changes.
    fn refused(line: &str, why: &str) {
        let folder = pictures();
        fs::write(folder.path().join("a.scene"), "v 0 0 -9").unwrap();
        fs::write(folder.path().join("plan"), "").unwrap();
        let files = || -> Vec<_> {
            let names = names(folder.path()).into_iter();
            names
                .map(|name| fs::read(folder.path().join(name)).unwrap())
                .collect()
        };
        let before = files();
        octray(folder.path(), line)
            .assert()
            .code(2)
            .stdout_eq("")
            .stderr_eq(format!(
                "error: {why}\n\nFor more information, try '--help'.\n"
            ));
        assert_eq!(files(), before, "{line}");
    }

    fn no_input_is_replaced(cases: &[(&str, &str, &str)]) {
        for (line, result, input) in cases {
            let why = format!(
                "the result {result} would replace {input}, which is read: name another file"
            );
            refused(line, &why);
        }
    }

    #[test]
    fn inputs_are_not_replaced() {
        no_input_is_replaced(&[
            ("render a.ppm -o ./a.ppm", "./a.ppm", "a.ppm"),
            ("bake a.scene -o ./a.scene", "./a.scene", "a.scene"),
            ("diff a.ppm b.ppm -o ./a.ppm", "./a.ppm", "a.ppm"),
            ("diff a.ppm ./b.ppm -o b.ppm", "b.ppm", "./b.ppm"),
        ]);
    }

    #[cfg(feature = "lab")]
    #[test]
    fn inputs_of_the_laboratory_are_not_replaced() {
        no_input_is_replaced(&[
            ("bake a.scene --plan plan -o ./plan", "./plan", "plan"),
            ("schedule a.scene --csv ./a.scene", "./a.scene", "a.scene"),
            ("measure a.scene --json ./a.scene", "./a.scene", "a.scene"),
            ("plan a.scene --emit ./a.scene", "./a.scene", "a.scene"),
            ("chart a.scene --csv ./a.scene", "./a.scene", "a.scene"),
            ("report a.scene -o ./a.scene", "./a.scene", "a.scene"),
            (
                "tables --record a.scene -o ./a.scene",
                "./a.scene",
                "a.scene",
            ),
            (
                "tables --thesis a.scene -o ./a.scene",
                "./a.scene",
                "a.scene",
            ),
        ]);
    }

    #[cfg(feature = "lab")]
    #[test]
    fn no_result_replaces_another() {
        for line in [
            "schedule a.scene -o c.svg --csv ./c.svg",
            "measure a.scene --csv c.svg --chart ./c.svg",
            "chart a.scene --output c.svg --json ./c.svg",
            "stability --json c.svg --csv ./c.svg",
        ] {
            let why = "the results c.svg and ./c.svg are one file: name another for one of them";
            refused(line, why);
        }
    }
}

mod usage {
    use super::*;

    #[test]
    fn help_goes_to_standard_output_and_errors_do_not() {
        octray(Path::new("."), "--help")
            .assert()
            .success()
            .stderr_eq("");
        octray(Path::new("."), "").assert().code(2).stdout_eq("");
        octray(Path::new("."), "paint")
            .assert()
            .code(2)
            .stdout_eq("");
        octray(Path::new("."), "diff a")
            .assert()
            .code(2)
            .stdout_eq("");
    }

    #[test]
    fn the_version_is_printed() {
        let expected = format!("octray {}\n", env!("CARGO_PKG_VERSION"));
        octray(Path::new("."), "--version")
            .assert()
            .success()
            .stdout_eq(expected);
    }
}

#[cfg(unix)]
mod streams {
    use super::*;
    use std::fs::File;
    use std::io::Read;
    use std::process::{Command, Stdio};

    fn diff(folder: &Path) -> Command {
        let mut command = Command::new(cargo_bin!("octray"));
        command.current_dir(folder).args(["diff", "a.ppm", "b.ppm"]);
        command
    }

    #[test]
    fn a_closed_pipe_is_no_failure() {
        let (reader, writer) = std::io::pipe().unwrap();
        drop(reader);
        let output = diff(pictures().path())
            .stdout(writer)
            .stderr(Stdio::piped())
            .spawn()
            .and_then(std::process::Child::wait_with_output)
            .unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert_data_eq!(String::from_utf8(output.stderr).unwrap(), "");
    }

    #[test]
    fn a_reader_may_stop_before_the_end() {
        let mut child = Command::new(cargo_bin!("octray"))
            .args(["generate", "soup", "--count", "20000"])
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut start = [0; 16];
        child.stdout.take().unwrap().read_exact(&mut start).unwrap();
        let output = child.wait_with_output().unwrap();
        assert_eq!(output.status.code(), Some(0));
        assert_data_eq!(String::from_utf8(output.stderr).unwrap(), "");
        assert_eq!(&start, b"# octray generat");
    }

    #[test]
    fn a_full_standard_output_is_a_failure() {
        let Ok(full) = File::options().write(true).open("/dev/full") else {
            return;
        };
        let output = diff(pictures().path())
            .stdout(full)
            .stderr(Stdio::piped())
            .spawn()
            .and_then(std::process::Child::wait_with_output)
            .unwrap();
        assert_eq!(output.status.code(), Some(1));
        let expected =
            "error: cannot write to standard output: No space left on device (os error 28)\n";
        assert_data_eq!(String::from_utf8(output.stderr).unwrap(), expected);
    }
}
