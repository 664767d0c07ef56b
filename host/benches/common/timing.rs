//! Renderings to be timed.

use clap::Parser;
use octray::cli::{Cli, Command};
use octray::error::Error;
use octray::job::RenderJob;
use std::path::Path;

/// What `octray render` makes of a scene and options, which white space separates.
///
/// # Errors
/// [`Error::Usage`] if it does not take them.
pub(crate) fn job(scene: &Path, options: &str) -> Result<RenderJob, Error> {
    let line = ["octray".as_ref(), "render".as_ref(), scene.as_os_str()];
    let options = options.split_whitespace().map(AsRef::as_ref);
    match Cli::try_parse_from(line.into_iter().chain(options)).map(|cli| cli.command) {
        Ok(Command::Render(args)) => args.job(),
        Ok(other) => Err(Error::Usage(format!("{other:?} does not render"))),
        Err(error) => Err(Error::Usage(error.to_string())),
    }
}

/// The median of a value over all samples, of which there is at least one.
pub(crate) fn median<T>(samples: &[T], value: impl Fn(&T) -> f64) -> f64 {
    let mut values: Vec<_> = samples.iter().map(value).collect();
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() % 2 {
        1 => values[middle],
        _ => (values[middle - 1] + values[middle]) / 2.0,
    }
}
