//! `octray diff` end to end: what it prints, what it writes, and its exit codes.

mod common;

use common::{names, octray, pictures, ppm};
use snapbox::str;
use std::fs;

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
            "not a picture known here (PNG, PPM P6, PFM, Sun rasterfile or intensity file)",
        ),
        ("empty.png", "the file is empty"),
        (".", "is a directory"),
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
error: invalid value 'heat.bmp' for '--output <FILE>': '.bmp' is no picture format known here; the known ones are .png, .apng, .ppm, .pfm, .ras, .int

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
