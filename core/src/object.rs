//! References to objects: a kind, and a place among the objects of that kind.

/// The kind of an object, and with it the array of a scene's shapes that holds it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum ObjectKind {
    /// A sphere.
    Sphere,
    /// A polygon of three vertices.
    Triangle,
    /// A polygon of more.
    Polygon,
    /// A truncated cone or a cylinder.
    Cone,
    /// A box.
    Cuboid,
}

impl ObjectKind {
    /// All kinds, in the order of their numbers.
    pub const ALL: [Self; 5] = [
        Self::Sphere,
        Self::Triangle,
        Self::Polygon,
        Self::Cone,
        Self::Cuboid,
    ];
}

/// One object: its kind and its place in that kind's array, in one word. The last reference of a
/// list of links is marked.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(transparent)]
pub struct ObjectRef(u32);

impl ObjectRef {
    /// The most objects of one kind.
    pub const MAX_OBJECTS: usize = 1 << 28;
    const LAST: u32 = 1 << 31;
    /// No object: of a kind that there is not.
    pub(crate) const NONE: Self = Self(7 << 28);

    /// Object `index` of its kind; `index` below [`ObjectRef::MAX_OBJECTS`].
    #[inline(always)]
    pub const fn new(kind: ObjectKind, index: u32) -> Self {
        Self((kind as u32) << 28 | index & 0x0fff_ffff)
    }

    /// Its kind.
    #[inline(always)]
    pub const fn kind(self) -> ObjectKind {
        match (self.0 >> 28) & 7 {
            0 => ObjectKind::Sphere,
            1 => ObjectKind::Triangle,
            2 => ObjectKind::Polygon,
            3 => ObjectKind::Cone,
            _ => ObjectKind::Cuboid,
        }
    }

    /// Its place in its kind's array.
    #[inline(always)]
    pub const fn index(self) -> usize {
        (self.0 & 0x0fff_ffff) as usize
    }

    /// Whether both refer to the same object, marked or not.
    #[inline(always)]
    pub(crate) const fn is_same(self, other: Self) -> bool {
        (self.0 ^ other.0) & !Self::LAST == 0
    }

    /// Whether it is marked as the last of its list.
    #[inline(always)]
    pub const fn is_last(self) -> bool {
        self.0 & Self::LAST != 0
    }

    /// The same object with or without the mark.
    #[inline(always)]
    #[must_use]
    pub const fn marked_last(self, last: bool) -> Self {
        Self(self.0 & !Self::LAST | if last { Self::LAST } else { 0 })
    }
}
