//! A scene in every arithmetic, each beside a map of the differences from the picture in 64-bit floats.

use super::ReportJob;
use crate::measure::frames::NamedScene;
use crate::measure::reference;
use crate::page::{self, Section, quoted};
use maud::{Markup, html};
use octray_prepare::{Arith, RenderSettings};
use octray_render::counts::thousands;
use octray_render::error::Error;
use octray_render::heat;
use octray_render::interrupt::Interrupt;
use octray_render::metric::Difference;
use octray_render::progress::Progress;
use octray_render::render::Rendering;
use std::path::Path;

/// Returns the section of a scene, the `index`th.
///
/// # Errors
/// On an interrupt, or if the scene cannot be rendered even in 64-bit floats.
pub(super) fn section(
    index: usize,
    scene: &NamedScene,
    path: &Path,
    job: &ReportJob,
    progress: &dyn Progress,
    interrupt: &Interrupt,
) -> Result<Section, Error> {
    let settings = RenderSettings {
        size: Some(job.size),
        ..RenderSettings::DEFAULT
    };
    let render = |arith| reference::render(&scene.scene, arith, &settings, interrupt);
    let exact = render(Arith::F64)?;
    let (mut figures, mut shown) = (Vec::new(), Vec::new());
    for &arith in &job.ariths {
        figures.push(match render(arith) {
            Err(Error::Interrupted) => return Err(Error::Interrupted),
            Err(refused) => html! {
                figure { figcaption { strong { (arith.name()) } ": " (refused) } }
            },
            Ok(traced) => {
                shown.push(arith.name());
                figure(arith, &traced, &exact)?
            }
        });
        progress.step();
    }
    let (width, height) = job.size;
    let name = &scene.name;
    Ok(Section {
        id: format!("pictures-{index}"),
        title: format!("{name} in every arithmetic"),
        body: html! {
            p {
                "The picture on the left, its differences from 64-bit floats on the right: dim grey for equal pixels, "
                "from violet (1 level) over red to yellow (255 levels) for larger differences. "
                (width) " × " (height) " pixels."
            }
            div.pictures { @for figure in &figures { (figure) } }
        },
        commands: commands(name, path, job.size, &shown),
    })
}

/// Returns shell loops that render a scene in these arithmetics and draw the differences.
fn commands(name: &str, path: &Path, (width, height): (u32, u32), shown: &[&str]) -> Vec<String> {
    let (file, name) = (quoted(path), quoted(Path::new(name)));
    let others: Vec<&str> = (shown.iter().copied())
        .filter(|arith| *arith != Arith::F64.name())
        .collect();
    let for_all = |ariths: &[&str]| format!("for arith in {}; do", ariths.join(" "));
    let exact = format!("{name}-f64.png");
    let mut commands = vec![
        for_all(&[&[Arith::F64.name()], &*others].concat()),
        format!(
            "  octray render {file} --arith $arith --size {width}x{height} -o {name}-$arith.png"
        ),
        "done".into(),
    ];
    if !others.is_empty() {
        let differences = format!("-o {name}-$arith-difference.png");
        commands.extend([
            for_all(&others),
            format!("  octray diff {exact} {name}-$arith.png {differences}"),
            "done".into(),
        ]);
    }
    commands
}

/// Returns the picture, its map, and its distance.
fn figure(arith: Arith, traced: &Rendering, exact: &Rendering) -> Result<Markup, Error> {
    let difference = Difference::between(&exact.picture, &traced.picture)?;
    let share = 100.0 * difference.beyond_1 as f64 / difference.pixels.max(1) as f64;
    let arith = arith.with_format(Some(traced.format));
    let says = match difference.is_zero() {
        true => "equal to f64".into(),
        false => format!(
            "{:.1} dB, {} pixels ({share:.2} %) off by more than 1 level",
            difference.psnr(),
            thousands(difference.beyond_1)
        ),
    };
    let map = heat::map(&exact.picture, &traced.picture)?;
    Ok(html! {
        figure {
            div.pair {
                (page::image(&traced.picture, &format!("rendered in {arith}"))?)
                (page::image(&map, &format!("differences of {arith} from f64"))?)
            }
            figcaption { strong { (arith) } ": " (says) }
        }
    })
}
