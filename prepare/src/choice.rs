//! Names of the values of fixed lists, for command lines, messages and files.

use strum::{EnumMessage, VariantArray};

/// A value of a fixed list whose values have names.
pub trait Choice: Copy + PartialEq + Send + Sync + 'static {
    /// Returns all values, in the order in which help lists them.
    fn all() -> Vec<Self>;

    /// Returns the name.
    fn name(self) -> &'static str;

    /// Returns all accepted names, including [`Choice::name`].
    fn names(self) -> Vec<&'static str>;

    /// Describes the value in one line.
    fn help(self) -> &'static str;

    /// Returns the value of that name, if there is one.
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
