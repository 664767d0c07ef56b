//! What the builders of all trees share: their options, their limits, and what they report.

/// No tree is deeper than this, whatever the options say: the walk's stack is sized for it.
pub(super) const MAX_DEPTH: u32 = 24;

/// How far a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildOptions {
    /// Inner nodes above any leaf, at most; at least 1 and no more than 24 count (8 in a
    /// [`CompactBvh8`](super::CompactBvh8)).
    pub depth: u32,
    /// A node with no more objects than this is a leaf; at least 1.
    pub leaf_size: u32,
}

/// What was built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct BuildStats {
    /// Inner nodes.
    pub inner: u32,
    /// Leaves, empty ones included where the tree has such.
    pub leaves: u32,
    /// Links from leaves to objects.
    pub links: u32,
    /// The most inner nodes above a leaf.
    pub depth: u32,
    /// Leaves that hold more than the leaf size because the arena was full. Such a tree gives the
    /// same pictures, only slower.
    pub unsplit: u32,
}

impl BuildStats {
    /// No tree, but a list of this many links, as [`BruteForce`](super::BruteForce) is.
    pub fn of_list(links: u32) -> Self {
        Self {
            links,
            ..Self::default()
        }
    }
}

/// The lent memory is too small even for an unsplit tree.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuildError {
    /// Nodes needed at least.
    pub nodes: usize,
    /// Links needed at least, one for each object.
    pub links: usize,
}

impl core::fmt::Display for BuildError {
    fn fmt(&self, f: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { nodes, links } = self;
        write!(f, "a tree takes at least {nodes} nodes and {links} links")
    }
}

impl core::error::Error for BuildError {}
