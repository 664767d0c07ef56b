//! The command built without the laboratory.
#![cfg(not(feature = "lab"))]

use snapbox::cmd::cargo_bin;
use std::process::{Command, Output};

fn octray(line: &str) -> Output {
    let mut command = Command::new(cargo_bin!("octray"));
    command.args(line.split_whitespace()).output().unwrap()
}

#[test]
fn commands_of_the_laboratory_report_in_one_line_how_to_get_them() {
    for name in [
        "measure",
        "chart",
        "plan",
        "schedule",
        "tables",
        "report",
        "stability",
        "panel",
    ] {
        for line in [
            name.into(),
            format!("{name} --help"),
            format!("{name} a.scene -o b"),
        ] {
            let output = octray(&line);
            let text = String::from_utf8(output.stderr).unwrap();
            let first = text.lines().next().unwrap();
            assert_eq!(output.status.code(), Some(2), "{line}");
            assert!(first.contains(&format!("'{name}'")), "{line}: {text}");
            assert!(
                first.contains("cargo install --path host --features lab"),
                "{text}"
            );
        }
    }
}

#[test]
fn a_plan_needs_the_laboratory() {
    // Reported before the scene is read.
    let output = octray("bake none.scene --plan none.plan");
    let text = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(
        text.contains("'--plan'") && text.contains("--features lab"),
        "{text}"
    );
}

#[test]
fn help_lists_the_built_and_the_missing_commands() {
    let help = String::from_utf8(octray("--help").stdout).unwrap();
    let (commands, more) = help.split_once("Built with --features lab").unwrap();
    for name in ["render", "check", "diff", "generate", "bake"] {
        assert!(commands.contains(&format!("\n  {name} ")), "{name}: {help}");
    }
    assert!(
        !commands.contains("chart") && more.contains("chart"),
        "{help}"
    );
}
