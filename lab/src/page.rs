//! The page: HTML that needs neither network nor scripts, with the reader's light or dark colours.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use maud::{DOCTYPE, Markup, PreEscaped, html};
use octray_render::error::Error;
use octray_render::picture::Picture;

/// The style sheet.
const STYLE: &str = include_str!("page.css");

/// A part of the page.
#[derive(Clone, Debug)]
pub(crate) struct Section {
    /// Its anchor within the page.
    pub(crate) id: String,
    /// Its heading.
    pub(crate) title: String,
    /// What it shows.
    pub(crate) body: Markup,
    /// The commands that reproduce it.
    pub(crate) commands: Vec<String>,
}

/// Returns the whole page: a title, what it is about in a few sentences, and its parts.
pub(crate) fn of(title: &str, about: &str, sections: &[Section]) -> Markup {
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { "octray: " (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                header {
                    h1 { (title) }
                    p {
                        (about) " Made by octray " (env!("CARGO_PKG_VERSION")) "; each part ends with the command "
                        "that reproduces it."
                    }
                    nav {
                        @for section in sections {
                            a href={ "#" (section.id) } { (section.title) }
                        }
                    }
                }
                main {
                    @for section in sections {
                        section id=(section.id) {
                            h2 { (section.title) }
                            (section.body)
                            (commands(&section.commands))
                        }
                    }
                }
            }
        }
    }
}

/// Returns commands as they are typed.
pub(crate) fn commands(commands: &[String]) -> Markup {
    html! {
        @if !commands.is_empty() {
            pre.command { code { (commands.join("\n")) } }
        }
    }
}

/// Returns a picture within the page, as PNG.
///
/// # Errors
/// If it cannot be encoded.
pub(crate) fn image(picture: &Picture, says: &str) -> Result<Markup, Error> {
    let png = (picture.png()).map_err(|cause| Error::Failed(format!("no PNG: {cause}")))?;
    let data = BASE64_STANDARD.encode(png);
    let (width, height) = picture.size();
    Ok(html! {
        img src={ "data:image/png;base64," (data) } width=(width) height=(height) alt=(says);
    })
}

/// Returns a chart that was drawn as SVG.
pub(crate) fn chart(svg: &str, says: &str) -> Markup {
    html! {
        figure.chart role="img" aria-label=(says) { (PreEscaped(svg)) }
    }
}

/// Returns a table whose first columns hold words, aligned left, and the others numbers, aligned right.
pub(crate) fn table(head: &[impl AsRef<str>], words: usize, rows: &[Vec<String>]) -> Markup {
    let class = |column: usize| (column >= words).then_some("number");
    html! {
        div.wide {
            table {
                thead { tr { @for (i, name) in head.iter().enumerate() { th scope="col" class=[class(i)] { (name.as_ref()) } } } }
                tbody {
                    @for row in rows {
                        tr { @for (i, cell) in row.iter().enumerate() { td class=[class(i)] { (cell) } } }
                    }
                }
            }
        }
    }
}

/// Quotes a path for a shell.
pub(crate) fn quoted(path: &std::path::Path) -> String {
    crate::chart::point::quoted(&path.to_string_lossy())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn page(title: &str) -> String {
        let section = Section {
            id: "a".into(),
            title: title.into(),
            body: html! { p { "b" } },
            commands: vec!["octray x".into(), "octray y".into()],
        };
        of("A title", "About it.", &[section]).into_string()
    }

    #[test]
    fn names_are_text_and_not_markup() {
        let page = page("<b>");
        assert!(page.contains("<h2>&lt;b&gt;</h2>"), "{page}");
        assert!(!page.contains("<b>"));
    }

    #[test]
    fn commands_stand_below_and_sections_have_anchors() {
        let page = page("a");
        assert!(page.contains("octray x\noctray y"), "{page}");
        assert!(page.contains("<a href=\"#a\">a</a>"), "{page}");
    }

    #[test]
    fn a_picture_is_in_the_page() {
        let picture = Picture::black(2, 3, false).unwrap();
        let image = image(&picture, "\"black\"").unwrap().into_string();
        assert!(image.starts_with("<img src=\"data:image/png;base64,iVBOR"));
        assert!(
            image.ends_with("width=\"2\" height=\"3\" alt=\"&quot;black&quot;\">"),
            "{image}"
        );
    }
}
