//! Checks that every command in README and docs runs as written and prints what is shown, and that every link has a
//! target.
#![cfg(feature = "lab")]

use snapbox::cmd::cargo_bin;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..")
}

/// Runs the commands of a page in a scratch copy of the checkout.
fn check(page: &str) {
    let mut command = Command::new("python3");
    command
        .current_dir(root())
        .args(["docs/refresh", "--check", page])
        .env("OCTRAY", cargo_bin!("octray"));
    let Ok(output) = command.output() else {
        eprintln!("not tested: there is no python3 to run docs/refresh");
        return;
    };
    let text = String::from_utf8_lossy(&output.stdout);
    assert!(
        output.status.success(),
        "{text}\nafter a change: docs/refresh {page}"
    );
}

macro_rules! pages {
    ($($name:ident: $page:literal),* $(,)?) => {
        const PAGES: &[&str] = &[$($page),*];

        $(#[test]
        fn $name() {
            check($page);
        })*
    };
}

pages! {
    introduction: "README.md",
    accelerators: "docs/accelerators.md",
    accuracy: "docs/accuracy.md",
    arithmetic: "docs/arithmetic.md",
    firmware: "docs/firmware.md",
    guide: "docs/guide.md",
    measurements: "docs/measurements.md",
    parallel: "docs/parallel.md",
    scene_files: "docs/scene-files.md",
    small_targets: "docs/small-targets.md",
    stability: "docs/stability.md",
    thesis: "docs/thesis.md",
    thesis_tables: "docs/thesis-tables.md",
}

#[test]
fn every_page_is_checked() {
    let pages = std::fs::read_dir(root().join("docs")).unwrap();
    for page in pages {
        let name = page.unwrap().file_name().into_string().unwrap();
        let checked = PAGES.contains(&&*format!("docs/{name}"));
        // An index and the model have no commands.
        let without = ["README.md", "MODEL.md"].contains(&&*name);
        assert!(!name.ends_with(".md") || checked || without, "docs/{name}");
    }
}
