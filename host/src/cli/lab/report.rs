//! Arguments of `octray report`.

use super::lists;
use crate::cli::{files, value};
use clap::Args;
use octray_lab::chart::ChartJob;
use octray_lab::chart::cost::CostKind;
use octray_lab::chart::point::{Against, Wishes};
use octray_lab::chart::setting::Grid;
use octray_lab::report::ReportJob;
use octray_prepare::{Arith, PixelsPerRay, RenderSettings, Samples, TreeKind};
use octray_render::error::Error;
use octray_stability::sweep;
use std::num::NonZeroUsize;
use std::path::PathBuf;

/// Arguments of `octray report`.
#[derive(Clone, Debug, Args)]
#[command(after_help = "\
The page needs neither network nor scripts. It shows pictures in every arithmetic and where they differ, charts of \
accuracy against cost, table III and sizes from the newest record of octray measure, and maps of where methods fail. Each \
part ends with the command that reproduces it. Costs are those of octray chart; if the tool that counts them is missing, \
the page says so.")]
pub struct ReportArgs {
    /// Scene files [default: the five figures]
    #[arg(value_name = "SCENE")]
    scenes: Vec<PathBuf>,
    /// The page to write
    #[arg(short, long, value_name = "FILE", default_value = "report.html")]
    output: PathBuf,
    /// Arithmetics, separated by commas
    #[arg(long, value_name = "LIST", value_parser = value::choice::<Arith>(), value_delimiter = ',', default_value = ARITHS)]
    arith: Vec<Arith>,
    /// Columns and rows of the pictures; the framing stays the same
    #[arg(long, value_name = "WxH", default_value = "256x192", value_parser = value::size)]
    size: (u32, u32),
    /// Cost of a frame in the charts: host-time, host-instructions, events, or a board
    #[arg(long, value_name = "LIST", value_delimiter = ',', default_value = "host-instructions,m3", value_parser = CostKind::named)]
    cost: Vec<CostKind>,
    /// Columns and rows of the frames in the charts
    #[arg(long, value_name = "WxH", default_value = "64x48", value_parser = value::size)]
    chart_size: (u32, u32),
    /// Threads that search for limits [default: all cores]
    #[arg(long, value_name = "N", value_parser = value::threads)]
    threads: Option<NonZeroUsize>,
}

const ARITHS: &str =
    "f64,f32,approx2,approx1,approx0,i32f32,i4f28,i8f24,i12f20,i16f16,i20f12,i24f8";

impl ReportArgs {
    /// Returns the job, without duplicates.
    ///
    /// # Errors
    /// [`Error::Usage`] if the page would replace a scene.
    pub fn job(self) -> Result<ReportJob, Error> {
        files::distinct(&self.scenes, [&self.output])?;
        let ariths = lists::once(self.arith, |a, b| a == b);
        let costs = lists::once(self.cost, |a, b| a.name() == b.name());
        Ok(ReportJob {
            output: self.output,
            size: self.size,
            chart: ChartJob {
                scenes: self.scenes,
                grid: Grid {
                    ariths: ariths.clone(),
                    // Boards support this kind; with it the charts are comparable.
                    trees: vec![TreeKind::CompactBvh8],
                    max_depths: vec![RenderSettings::DEFAULT.max_depth],
                    cut_offs: vec![RenderSettings::DEFAULT.cut_off],
                    pixels_per_ray: vec![PixelsPerRay::One],
                    samples: vec![Samples::Uniform(1)],
                },
                costs,
                size: self.chart_size,
                converged_samples: 8,
                rounds: const { NonZeroUsize::new(5).unwrap() },
                wishes: Wishes {
                    against: Against::Same,
                    min_psnr: 40.0,
                    budget: None,
                },
                output: None,
                csv: None,
                json: None,
            },
            ariths,
            methods: sweep::ALL.to_vec(),
            threads: self.threads.unwrap_or_else(|| {
                std::thread::available_parallelism().unwrap_or(NonZeroUsize::MIN)
            }),
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Debug, Parser)]
    struct TestCommand {
        #[command(flatten)]
        args: ReportArgs,
    }

    fn job(line: &str) -> Result<ReportJob, Error> {
        let words = std::iter::once("report").chain(line.split_whitespace());
        TestCommand::try_parse_from(words).unwrap().args.job()
    }

    #[test]
    fn duplicates_are_shown_once() {
        let job = job("a --arith f32,auto,f32 --cost m3,events,m3").unwrap();
        assert_eq!(job.ariths, [Arith::F32, Arith::Auto]);
        assert_eq!(job.chart.costs.len(), 2);
        assert_eq!(job.output, PathBuf::from("report.html"));
    }

    #[test]
    fn a_page_does_not_replace_a_scene() {
        let error = job("a.scene -o a.scene").unwrap_err();
        assert!(error.to_string().contains("which is read"), "{error}");
    }
}
