//! Properties of every source and every scene.

mod support;

use octray_scenes::diagnostic::{MOST, MistakeKind};
use octray_scenes::{check, parse, write};
use proptest::collection::vec;
use proptest::prelude::*;
use support::scene;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(512))]

    #[test]
    fn any_scene_survives_a_file(scene in scene()) {
        prop_assert_eq!(check::scene(&scene), Ok(()));
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        match parse(&text) {
            Ok(again) => prop_assert_eq!(again, scene),
            Err(mistakes) => prop_assert!(false, "{}", mistakes.draw("scene", &text)),
        }
    }

    #[test]
    fn any_bytes_give_a_scene_or_mistakes_that_can_be_drawn(
        bytes in vec(any::<u8>(), 0..200)
    ) {
        judge(&String::from_utf8_lossy(&bytes))?;
    }

    #[test]
    fn any_text_gives_a_scene_or_mistakes_that_can_be_drawn(text in any::<String>()) {
        judge(&text)?;
    }

    /// Near misses: tokens of the language in any order.
    #[test]
    fn any_tokens_give_a_scene_or_mistakes_that_can_be_drawn(tokens in vec(token(), 0..60)) {
        judge(&tokens.concat())?;
    }

    /// A valid scene with a part cut out.
    #[test]
    fn a_scene_with_a_gap_gives_a_scene_or_mistakes_that_can_be_drawn(
        scene in scene(), from in any::<prop::sample::Index>(), length in 0usize..30
    ) {
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let from = from.index(text.len());
        text.drain(from..(from + length).min(text.len()));
        judge(std::str::from_utf8(&text).unwrap())?;
    }

    #[test]
    fn white_space_and_comments_have_no_meaning(scene in scene(), space in vec(space(), 16)) {
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let mut spaces = space.iter().cycle();
        let text: String = std::str::from_utf8(&text)
            .unwrap()
            .split_whitespace()
            .flat_map(|token| [token, spaces.next().unwrap()])
            .collect();
        prop_assert_eq!(parse(&text), Ok(scene));
    }
}

/// Checks that an accepted scene satisfies the invariants, and that mistakes are few, in order, and within the source.
fn judge(source: &str) -> Result<(), TestCaseError> {
    match parse(source) {
        Ok(scene) => prop_assert_eq!(check::scene(&scene), Ok(())),
        Err(mistakes) => {
            prop_assert!((1..=MOST).contains(&mistakes.list.len()));
            prop_assert!(mistakes.list.is_sorted_by_key(|mistake| mistake.span.start));
            for mistake in &mistakes.list {
                let span = mistake.span;
                prop_assert!(source.get(span.start..span.end).is_some(), "{:?}", mistake);
                if let MistakeKind::Duplicate { first, .. } = mistake.kind {
                    prop_assert!(first.end <= span.start);
                }
            }
            let drawn = mistakes.draw("scene", source);
            prop_assert!(
                !drawn.contains(|c: char| c.is_control() && c != '\n'),
                "{:?}",
                drawn
            );
        }
    }
    Ok(())
}

fn token() -> impl Strategy<Value = String> {
    let words = "v from at up angle hither resolution view parallel perspective b l f s c box p pp";
    let numbers = "0 1 -1 0.5 2 3 3 4 12 1e-320 1e308 -1e308 1e999 nan 65536 4294967295 x 1.2.3";
    let any_of = |words: &'static str| prop::sample::select(words.split(' ').collect::<Vec<_>>());
    let token = prop_oneof![2 => any_of(words), 7 => any_of(numbers)];
    (token, space()).prop_map(|(token, space)| format!("{token}{space}"))
}

fn space() -> impl Strategy<Value = &'static str> {
    prop::sample::select(vec![
        " ",
        "  ",
        "\t",
        "\n",
        "\r\n",
        "\r",
        "\u{c}",
        "\t#v 1 2 3\n",
        " # s 0 \u{e9}\r\n",
    ])
}
