//! Surfaces of the usual kinds, to begin with: every field can be changed afterwards.

use crate::model::{Checker, Colour, Surface};
use crate::point::times;

impl Surface {
    /// Returns a surface that scatters light: 12 % of `colour` is ambient, 88 % diffuse.
    ///
    /// The channels of `colour` are linear, 0 to 1 as a rule.
    #[must_use]
    pub fn matt(colour: Colour) -> Self {
        Self {
            ambient: times(colour, 0.12),
            diffuse: times(colour, 0.88),
            ..Self::default()
        }
    }

    /// Returns a surface with a white highlight of half the light's brightness, which mirrors the share `reflect`.
    ///
    /// 10 % of `colour` is ambient, and what is left of 90 % after `reflect` is diffuse. The larger the exponent `shine`
    /// (10 to 1000 as a rule), the smaller the highlight. `reflect` is 0 to 1 as a rule; from 0.9 on nothing is diffuse.
    #[must_use]
    pub fn glossy(colour: Colour, shine: f64, reflect: f64) -> Self {
        Self {
            ambient: times(colour, 0.1),
            diffuse: times(colour, (0.9 - reflect).max(0.0)),
            specular: [0.5; 3],
            shine,
            reflect,
            ..Self::default()
        }
    }

    /// Returns clear glass of the refraction index `ior` (1.5 is window glass, 1.33 water): it transmits 85 % of the
    /// light, mirrors 10 %, and has a small highlight.
    #[must_use]
    pub fn glass(ior: f64) -> Self {
        Self {
            specular: [0.6; 3],
            shine: 120.0,
            reflect: 0.1,
            refract: 0.85,
            ior,
            ..Self::default()
        }
    }

    /// Returns the surface with the ambient and diffuse colours of `other` in every second cube of space, whose sides
    /// are `size` scene units long. Cubes begin at the origin.
    #[must_use]
    pub fn checkered(self, size: f64, other: Self) -> Self {
        let Self {
            ambient, diffuse, ..
        } = other;
        Self {
            checker: Some(Checker {
                size,
                ambient,
                diffuse,
            }),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::check;

    #[test]
    fn the_usual_surfaces_are_valid_and_as_described() {
        let white = [1.0; 3];
        let matt = Surface::matt(white);
        assert_eq!((matt.ambient, matt.diffuse), ([0.12; 3], [0.88; 3]));
        let mirror = Surface::glossy(white, 50.0, 1.0);
        assert_eq!((mirror.diffuse, mirror.reflect), ([0.0; 3], 1.0));
        let checkered = matt.checkered(2.0, mirror);
        let checker = checkered.checker.unwrap();
        assert_eq!((checker.size, checker.ambient), (2.0, [0.1; 3]));
        for surface in [matt, mirror, Surface::glass(1.5), checkered] {
            assert_eq!(check::surface(&surface), Ok(()));
        }
    }
}
