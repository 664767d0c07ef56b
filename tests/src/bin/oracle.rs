//! `oracle SCENE OUT.ppm [--size WxH] [--pixels-per-ray N] [--samples K] [--max-depth D] [--cut-off C]`: renders a
//! scene with the oracle, writes the picture and prints the numbers of rays by kind.

use std::error::Error;
use std::str::FromStr;
use std::time::Instant;

use octray_tests::oracle::{Options, render};

const USAGE: &str = "usage: oracle SCENE OUT.ppm [--size WxH] [--pixels-per-ray N] [--samples K] [--max-depth D] [--cut-off C]";

fn main() -> Result<(), Box<dyn Error>> {
    let mut files = Vec::new();
    let mut options = Options::default();
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        if !argument.starts_with("--") {
            files.push(argument);
            continue;
        }
        let value = arguments
            .next()
            .ok_or_else(|| format!("{argument} needs a value\n{USAGE}"))?;
        match argument.as_str() {
            "--size" => {
                let (width, height) = value.split_once('x').ok_or("--size needs WxH")?;
                options.size = Some((number(width)?, number(height)?));
            }
            "--pixels-per-ray" => options.pixels_per_ray = number(&value)?,
            "--samples" => options.samples = number(&value)?,
            "--max-depth" => options.max_depth = number(&value)?,
            "--cut-off" => options.cut_off = number(&value)?,
            _ => return Err(format!("{argument} is not an option\n{USAGE}").into()),
        }
    }
    let [scene, out] = &files[..] else {
        return Err(USAGE.into());
    };

    let source = std::fs::read_to_string(scene).map_err(|error| format!("{scene}: {error}"))?;
    let start = Instant::now();
    let picture = render(&source, &options);
    let seconds = start.elapsed().as_secs_f64();

    let mut bytes = format!("P6\n{} {}\n255\n", picture.width, picture.height).into_bytes();
    bytes.extend_from_slice(&picture.rgb);
    std::fs::write(out, bytes).map_err(|error| format!("{out}: {error}"))?;

    let counts = picture.counts;
    println!("primary     {}", counts.primary);
    println!("eye hits    {}", counts.eye_hits);
    println!("shadow      {}", counts.shadow);
    println!("blocked     {}", counts.blocked);
    println!("reflected   {}", counts.reflected);
    println!("transmitted {}", counts.transmitted);
    println!("seconds     {seconds:.2}");
    Ok(())
}

/// Parses a number of the command line.
fn number<T: FromStr>(text: &str) -> Result<T, String> {
    text.parse()
        .map_err(|_| format!("{text:?} is not such a number\n{USAGE}"))
}
