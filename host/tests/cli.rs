//! The command end to end: what it prints, what it writes, and its exit codes.

use snapbox::cmd::{Command, cargo_bin};
use snapbox::{assert_data_eq, str};
use std::fs;
use std::path::Path;
use tempfile::TempDir;

fn octray(folder: &Path, line: &str) -> Command {
    Command::new(cargo_bin!("octray"))
        .current_dir(folder)
        .args(line.split_whitespace())
}

fn ppm(levels: &[[u8; 3]]) -> Vec<u8> {
    let mut bytes = format!("P6\n{} 1\n255\n", levels.len()).into_bytes();
    bytes.extend(levels.as_flattened());
    bytes
}

/// Three pictures: `a.ppm`, `b.ppm` of the same size, and `wide.ppm`.
fn pictures() -> TempDir {
    let folder = TempDir::new().unwrap();
    let write = |name, levels: &[_]| fs::write(folder.path().join(name), ppm(levels)).unwrap();
    write("a.ppm", &[[0, 0, 0], [10, 10, 10], [100, 100, 100]]);
    write("b.ppm", &[[0, 1, 0], [12, 10, 10], [100, 100, 90]]);
    write("wide.ppm", &[[0; 3]; 4]);
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<_> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

mod diff {
    use super::*;

    #[test]
    fn prints_how_far_apart_two_pictures_are() {
        octray(pictures().path(), "diff a.ppm b.ppm")
            .assert()
            .success()
            .stderr_eq("")
            .stdout_eq(str![[r#"
PSNR                37.46 dB
RMSE                3.4157 levels
largest difference  10 levels
beyond 1 level      2 of 3 pixels (66.667 %)
beyond 8 levels     1 of 3 pixels (33.333 %)

"#]]);
    }

    #[test]
    fn equal_pictures_have_an_infinite_psnr_which_is_null_in_json() {
        let folder = pictures();
        octray(folder.path(), "diff a.ppm a.ppm --max-rmse 0 --min-psnr 99")
            .assert()
            .success()
            .stdout_eq(str![[r#"
PSNR                infinite: the pictures are equal
RMSE                0.0000 levels
largest difference  0 levels
beyond 1 level      0 of 3 pixels (0.000 %)
beyond 8 levels     0 of 3 pixels (0.000 %)

"#]]);
        octray(folder.path(), "diff a.ppm a.ppm --json")
            .assert()
            .success()
            .stdout_eq(str![[r#"
{"a":"a.ppm","b":"a.ppm","size":[3,1],"psnr":null,"rmse":0.0,"largest":0,"beyond_1":0,"beyond_8":0,"within_bounds":true}

"#]]);
    }

    #[test]
    fn an_exceeded_limit_is_reported_after_the_numbers() {
        octray(
            pictures().path(),
            "diff a.ppm b.ppm --json --max-difference 9 --max-beyond-1 60% --max-beyond-8 1",
        )
        .assert()
        .code(1)
        .stdout_eq(str![[r#"
{"a":"a.ppm","b":"b.ppm","size":[3,1],"psnr":37.461335712[..],"rmse":3.4156502553[..],"largest":10,"beyond_1":2,"beyond_8":1,"within_bounds":false}

"#]])
        .stderr_eq(str![[r#"
error: the largest difference is 10 levels, at most 9 allowed
error: pixels that differ by more than one level: 2, at most 60 % allowed

"#]]);
    }

    #[test]
    fn the_heat_map_is_a_picture_of_the_same_size() {
        let folder = pictures();
        for name in ["heat.png", "heat.ppm", "heat.pfm", "heat.ras"] {
            octray(folder.path(), &format!("diff a.ppm b.ppm -o {name}"))
                .assert()
                .success();
            octray(
                folder.path(),
                &format!("diff {name} heat.png --max-difference 0"),
            )
            .assert()
            .success();
        }
    }

    #[test]
    fn pictures_of_different_sizes_are_not_compared() {
        let folder = pictures();
        octray(folder.path(), "diff a.ppm wide.ppm -o heat.png")
            .assert()
            .code(1)
            .stdout_eq("")
            .stderr_eq(str![[r#"
error: the pictures differ in size: 3x1 and 4x1

"#]]);
        assert_eq!(names(folder.path()), ["a.ppm", "b.ppm", "wide.ppm"]);
    }

    #[test]
    fn an_unreadable_file_is_named_with_the_cause() {
        let folder = pictures();
        let cut = &ppm(&[[1; 3]; 9])[..20];
        fs::write(folder.path().join("cut.ppm"), cut).unwrap();
        fs::write(folder.path().join("text.png"), "no picture").unwrap();
        fs::write(folder.path().join("empty.png"), "").unwrap();
        for (name, cause) in [
            ("missing.png", "No such file or directory (os error 2)"),
            ("cut.ppm", "the picture is cut short"),
            (
                "text.png",
                "not a picture known here (PNG, PPM P6, PFM or Sun rasterfile)",
            ),
            ("empty.png", "the file is empty"),
            (".", "Is a directory (os error 21)"),
        ] {
            octray(folder.path(), &format!("diff a.ppm {name}"))
                .assert()
                .code(1)
                .stderr_eq(format!("error: cannot read {name}: {cause}\n"));
        }
    }

    #[test]
    fn an_unknown_extension_is_bad_usage_with_a_list_of_the_known_ones() {
        octray(pictures().path(), "diff a.ppm b.ppm -o heat.bmp")
            .assert()
            .code(2)
            .stdout_eq("")
            .stderr_eq(str![[r#"
error: invalid value 'heat.bmp' for '--output <FILE>': '.bmp' is no picture format known here; the known ones are .png, .ppm, .pfm, .ras

For more information, try '--help'.

"#]]);
    }

    #[test]
    fn a_missing_folder_is_reported() {
        octray(pictures().path(), "diff a.ppm b.ppm -o no/heat.png")
            .assert()
            .code(1)
            .stderr_eq(str![[r#"
error: cannot write no/heat.png: No such file or directory (os error 2)

"#]]);
    }
}

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

mod schedule {
    use super::*;

    /// A ball in the upper half of the picture, under a light.
    const SCENE: &str = "v 0 0 -9 resolution 64 64 l 0 99 -99 1\n\
        f 1 1 1 0 0 0 0 0 0 0 0.5 0\ns 0 16 5 12\n";

    #[test]
    fn the_best_tiles_are_printed_for_each_number_of_processors() {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("a.scene"), SCENE).unwrap();
        octray(
            folder.path(),
            "schedule a.scene --processors 1,2 --tile-rows 1..4 --tiles 4 --policy static,dynamic",
        )
        .assert()
        .success()
        .stdout_eq(str![[r#"
| processors | tiles |              static |             dynamic |
|------------|---------|---------------------|---------------------|
| 1          | strips  |        1.00 (1 row) |        1.00 (1 row) |
| 1          | tiles   | 1.00 (4 x 4 pixels) | 1.00 (4 x 4 pixels) |
| 2          | strips  |        1.94 (1 row) |       1.98 (4 rows) |
| 2          | tiles   | 2.00 (4 x 4 pixels) | 2.00 (4 x 4 pixels) |

"#]]);
    }

    #[test]
    fn every_combination_is_in_the_json_object() {
        let folder = TempDir::new().unwrap();
        fs::write(folder.path().join("a.scene"), SCENE).unwrap();
        let line = "schedule a.scene --processors 1..4 --tile-rows 2,8 --tiles 8 --json";
        let output = octray(folder.path(), line).output().unwrap();
        let object: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let runs = object["runs"].as_array().unwrap();
        assert_eq!(runs.len(), 3 * 3 * 6);
        for run in runs {
            let speed_up = run["speed_up"].as_f64().unwrap();
            let processors = run["processors"].as_f64().unwrap();
            assert!(speed_up > 0.99 && speed_up < processors * 1.001, "{run}");
        }
    }

    #[test]
    fn wrong_values_are_bad_usage() {
        for flags in [
            "--processors 0",
            "--tile-rows 4..1",
            "--policy luck",
            "--contention -1",
        ] {
            octray(Path::new("."), &format!("schedule a.scene {flags}"))
                .assert()
                .code(2);
        }
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

    #[test]
    fn inputs_are_not_replaced() {
        for (line, result, input) in [
            ("render a.ppm -o ./a.ppm", "./a.ppm", "a.ppm"),
            ("bake a.scene -o ./a.scene", "./a.scene", "a.scene"),
            ("bake a.scene --plan plan -o ./plan", "./plan", "plan"),
            ("diff a.ppm b.ppm -o ./a.ppm", "./a.ppm", "a.ppm"),
            ("diff a.ppm ./b.ppm -o b.ppm", "b.ppm", "./b.ppm"),
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
        ] {
            let why = format!(
                "the result {result} would replace {input}, which is read: name another file"
            );
            refused(line, &why);
        }
    }

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
