//! The operators of number types, each written as one expression.

/// Implements `+` and `-`, and where they are given `*` and the sign, for a type. The closures are
/// taken apart, not called: nothing depends on the optimiser.
macro_rules! operators {
    (@one [$($generics:tt)*] $type:ty, $trait:ident::$method:ident = |$a:ident, $b:ident| $body:expr) => {
        impl<$($generics)*> core::ops::$trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self, other: Self) -> Self {
                let ($a, $b) = (self, other);
                $body
            }
        }
    };
    (@one [$($generics:tt)*] $type:ty, $trait:ident::$method:ident = |$a:ident| $body:expr) => {
        impl<$($generics)*> core::ops::$trait for $type {
            type Output = Self;
            #[inline(always)]
            fn $method(self) -> Self {
                let $a = self;
                $body
            }
        }
    };
    ($generics:tt $type:ty, $($trait:ident::$method:ident = |$a:ident $(, $b:ident)?| $body:expr;)+) => {
        $(operators!(@one $generics $type, $trait::$method = |$a $(, $b)?| $body);)+
    };
}

pub(super) use operators;
