//! Shared parts of the tests: the oracle (a slow, simple renderer to compare octray with), random scenes, and
//! renderings with the settings of octray's command.

pub mod oracle;
pub mod shot;
/// In the folder of core's tests, which use it too.
#[path = "../../core/tests/support/strew.rs"]
pub mod strew;
