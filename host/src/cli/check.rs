//! Arguments of `octray check`.

use clap::Args;
use std::path::PathBuf;

/// Arguments of `octray check`.
#[derive(Clone, Debug, Args)]
pub struct CheckArgs {
    /// Scene files
    #[arg(required = true, value_name = "SCENE")]
    pub scenes: Vec<PathBuf>,
}
