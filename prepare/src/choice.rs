//! Names of what is chosen from a fixed list, for command lines, messages and files.

use strum::{EnumMessage, VariantArray};

/// One of a fixed list of values that have names.
pub trait Choice: Copy + PartialEq + Send + Sync + 'static {
    /// All values, in the order in which help lists them.
    fn all() -> Vec<Self>;

    /// The name.
    fn name(self) -> &'static str;

    /// All names that are understood, [`Choice::name`] included.
    fn names(self) -> Vec<&'static str>;

    /// What it is, in one line.
    fn help(self) -> &'static str;

    /// The value of that name, if there is one.
    fn named(name: &str) -> Option<Self> {
        Self::all()
            .into_iter()
            .find(|value| value.names().contains(&name))
    }
}

impl<T> Choice for T
where
    T: VariantArray + EnumMessage + Into<&'static str> + Copy + PartialEq + Send + Sync,
{
    fn all() -> Vec<Self> {
        Self::VARIANTS.to_vec()
    }

    fn name(self) -> &'static str {
        self.into()
    }

    fn names(self) -> Vec<&'static str> {
        self.get_serializations().to_vec()
    }

    fn help(self) -> &'static str {
        self.get_documentation().unwrap_or_default()
    }
}
