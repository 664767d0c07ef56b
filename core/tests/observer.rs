//! With `()` as the observer nothing of it is left in the machine code: the core without a single
//! call of it compiles to the same functions.

use object::{Object, ObjectSection, ObjectSymbol};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

#[test]
fn nobody_who_counts_costs_nothing() {
    let core = Path::new(env!("CARGO_MANIFEST_DIR"));
    let scratch = tempfile::tempdir().unwrap();
    let [as_it_is, without] = ["observed", "unobserved"].map(|name| scratch.path().join(name));
    for copy in [&as_it_is, &without] {
        copy_folder(core, &copy.join("core"));
    }
    let calls = strip_calls(&without.join("core/src"));
    assert!(calls >= 6, "only {calls} calls were found");

    let target = scratch.path().join("target");
    let (observed, unobserved) = (functions(&as_it_is, &target), functions(&without, &target));
    for name in ["octray_bvh8", "octray_octree", "octray_brute_force"] {
        assert!(observed[name].len() > 1000, "{name} is hardly there");
    }
    let differing: Vec<String> = observed
        .iter()
        // The compiler may put the same instructions in another order, or registers to another use, and what it weighs
        // before it inlines a function has the calls still in it. So a twentieth more is allowed.
        .filter(|(name, code)| {
            let other = unobserved.get(*name).map_or(0, Vec::len);
            code.len() > other + other / 20
        })
        .map(|(name, code)| {
            let other = unobserved.get(name).map(Vec::len);
            format!("{name}: {} bytes, {other:?} without", code.len())
        })
        .collect();
    assert!(differing.is_empty(), "{}", differing.join("\n"));
}

/// Copies what a package is built from.
fn copy_folder(from: &Path, to: &Path) {
    fs::create_dir_all(to).unwrap();
    for entry in fs::read_dir(from).unwrap() {
        let entry = entry.unwrap();
        let (path, copy) = (entry.path(), to.join(entry.file_name()));
        if path.is_dir() {
            copy_folder(&path, &copy);
        } else if path.file_name().is_some_and(|name| name == "Cargo.toml") {
            fs::write(copy, on_its_own(&fs::read_to_string(path).unwrap())).unwrap();
        } else {
            fs::copy(path, copy).unwrap();
        }
    }
}

/// A manifest without what it has from the workspace.
fn on_its_own(manifest: &str) -> String {
    let package = [("version", "0.1.0"), ("edition", "2024")];
    manifest
        .replace("[lints]\nworkspace = true\n", "")
        .lines()
        .filter_map(|line| match line.strip_suffix(".workspace = true") {
            None => Some(line.to_owned()),
            Some(key) => package
                .iter()
                .find(|(name, _)| *name == key)
                .map(|(name, value)| format!("{name} = \"{value}\"")),
        })
        .collect::<Vec<_>>()
        .join("\n")
}

/// Takes every call of an observer out of the sources in a folder; returns how many there were.
fn strip_calls(folder: &Path) -> usize {
    let mut count = 0;
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            count += strip_calls(&path);
            continue;
        }
        // The one call that is a question.
        let source = fs::read_to_string(&path).unwrap();
        let source = source.replace("if observer.stopped() {", "if false {");
        let is_call = |line: &&str| {
            let line = line.trim();
            ["observer.", "self.observer.", "query.observer."]
                .iter()
                .any(|start| line.starts_with(start) && line.ends_with(");"))
        };
        count += source.lines().filter(is_call).count();
        let rest: Vec<&str> = source.lines().filter(|line| !is_call(line)).collect();
        let rest = rest.join("\n");
        assert!(
            !rest.contains("observer."),
            "{}: a call of the observer is not a statement of one line",
            path.display()
        );
        fs::write(&path, rest).unwrap();
    }
    count
}

/// Builds the library of tests/thumb for this machine; the code of its functions, by name without
/// the hash.
fn functions(copy: &Path, target: &Path) -> BTreeMap<String, Vec<u8>> {
    let target = target.join(copy.file_name().unwrap());
    let output = Command::new(env!("CARGO"))
        .args(["rustc", "--release", "--", "--emit=obj"])
        .current_dir(copy.join("core/tests/thumb"))
        .env("CARGO_TARGET_DIR", &target)
        .env_remove("RUSTFLAGS")
        .output()
        .unwrap();
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let mut found = BTreeMap::new();
    for entry in fs::read_dir(target.join("release/deps")).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_none_or(|e| e != "o") {
            continue;
        }
        let bytes = fs::read(path).unwrap();
        let file = object::File::parse(bytes.as_slice()).unwrap();
        for symbol in file.symbols().filter(|symbol| symbol.size() > 0) {
            let section = symbol
                .section_index()
                .and_then(|i| file.section_by_index(i).ok());
            let Some(section) = section.filter(|s| s.kind() == object::SectionKind::Text) else {
                continue;
            };
            let code = section.data_range(symbol.address(), symbol.size()).unwrap();
            let name = symbol.name().unwrap();
            // Mangled names end in a hash of 16 digits.
            let name = name.find("17h").map_or(name, |hash| &name[..hash]);
            found.insert(name.to_owned(), code.unwrap_or_default().to_vec());
        }
    }
    found
}
