//! Writes scene files: one entity per line, in the thesis's dialect and our additions to it, with NFF's patch where
//! needed.

use crate::model::{Camera, Colour, Light, Object, Point, Projection, Scene, Shape, Surface};
use std::fmt;
use std::io::{self, Write};

/// Writes `scene` so that [`parse`](crate::parse()) returns the same scene, every number bit for bit.
///
/// This holds for scenes that were parsed or generated: their objects use the surfaces, vertices and normals in order.
/// For other scenes the picture is the same, but surfaces may be repeated and vertices reordered. The scene must pass
/// [`check::scene`](crate::check::scene).
///
/// # Errors
/// Those of `out`. Pass a buffered writer: there are many small writes.
///
/// # Panics
/// If an object's surface, vertices or normals are out of range.
pub fn write(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    header(scene, out)?;
    for light in &scene.lights {
        write_light(light, out)?;
    }
    let mut current = None;
    let mut unwritten = 0;
    for object in &scene.objects {
        let index = object.surface as usize;
        if current != Some(index) {
            // Unused surfaces keep their places.
            for surface in scene.surfaces.get(unwritten..index).unwrap_or_default() {
                write_surface(surface, out)?;
            }
            write_surface(&scene.surfaces[index], out)?;
            current = Some(index);
            unwritten = unwritten.max(index + 1);
        }
        write_object(scene, object, out)?;
    }
    for surface in &scene.surfaces[unwritten..] {
        write_surface(surface, out)?;
    }
    Ok(())
}

fn header(scene: &Scene, out: &mut impl Write) -> io::Result<()> {
    let projection = match &scene.camera {
        Camera::Thesis {
            viewpoint,
            projection,
        } => {
            writeln!(out, "v {}", Triple(viewpoint))?;
            projection
        }
        Camera::Nff {
            from,
            at,
            up,
            angle,
            projection,
        } => {
            writeln!(out, "v {}", Triple(from))?;
            writeln!(out, "at {}", Triple(at))?;
            writeln!(out, "up {}", Triple(up))?;
            writeln!(out, "angle {}", Number(*angle))?;
            projection
        }
    };
    if *projection == Projection::Parallel {
        writeln!(out, "view parallel")?;
    }
    writeln!(out, "resolution {} {}", scene.height, scene.width)?;
    write!(out, "b {}", Triple(&scene.background))?;
    if let Some(zenith) = &scene.zenith {
        write!(out, "  {}", Triple(zenith))?;
    }
    writeln!(out)
}

fn write_light(light: &Light, out: &mut impl Write) -> io::Result<()> {
    writeln!(
        out,
        "l {} {}",
        Triple(&light.position),
        Brightness(&light.colour)
    )
}

fn write_surface(surface: &Surface, out: &mut impl Write) -> io::Result<()> {
    let Surface {
        ambient,
        diffuse,
        specular,
        shine,
        reflect,
        refract,
        ior,
        checker,
    } = surface;
    let [ambient, diffuse, specular] = [ambient, diffuse, specular].map(Triple);
    let [shine, reflect, refract] = [*shine, *reflect, *refract].map(Number);
    write!(
        out,
        "f {ambient}  {diffuse}  {specular}  {shine} {reflect} {refract}"
    )?;
    if *ior != 1.0 {
        write!(out, " {}", Number(*ior))?;
    }
    writeln!(out)?;
    if let Some(checker) = checker {
        let (ambient, diffuse) = (Triple(&checker.ambient), Triple(&checker.diffuse));
        writeln!(
            out,
            "checker {}  {ambient}  {diffuse}",
            Number(checker.size)
        )?;
    }
    Ok(())
}

fn write_object(scene: &Scene, object: &Object, out: &mut impl Write) -> io::Result<()> {
    match &object.shape {
        Shape::Sphere { centre, radius } => {
            writeln!(out, "s {} {}", Triple(centre), Number(*radius))
        }
        Shape::Cone {
            base,
            base_radius,
            top,
            top_radius,
        } => {
            let (base, top) = (Triple(base), Triple(top));
            writeln!(
                out,
                "c {base} {}  {top} {}",
                Number(*base_radius),
                Number(*top_radius)
            )
        }
        Shape::Cuboid { centre, size } => {
            writeln!(out, "box {}  {}", Triple(centre), Triple(size))
        }
        Shape::Polygon { first, count } => {
            write!(out, "p {count}")?;
            for vertex in points(&scene.vertices, *first, *count) {
                write!(out, "  {}", Triple(vertex))?;
            }
            writeln!(out)
        }
        Shape::Patch {
            first,
            count,
            first_normal,
        } => {
            write!(out, "pp {count}")?;
            let vertices = points(&scene.vertices, *first, *count);
            let normals = points(&scene.normals, *first_normal, *count);
            for (vertex, normal) in vertices.iter().zip(normals) {
                write!(out, "  {} {}", Triple(vertex), Triple(normal))?;
            }
            writeln!(out)
        }
    }
}

fn points(list: &[Point], first: u32, count: u32) -> &[Point] {
    &list[first as usize..first as usize + count as usize]
}

/// Displays the fewest digits that parse to the same `f64`, with an exponent if that is shorter.
pub(crate) struct Number(pub(crate) f64);

impl fmt::Display for Number {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = self.0 == 0.0 || (1e-5..1e16).contains(&self.0.abs());
        if plain {
            write!(f, "{}", self.0)
        } else {
            write!(f, "{:e}", self.0)
        }
    }
}

/// Three numbers.
struct Triple<'p>(&'p Point);

impl fmt::Display for Triple<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [x, y, z] = self.0.map(Number);
        write!(f, "{x} {y} {z}")
    }
}

/// Displays one number for a white light, three otherwise.
struct Brightness<'c>(&'c Colour);

impl fmt::Display for Brightness<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let [r, g, b] = *self.0;
        if r == g && g == b {
            write!(f, "{}", Number(r))
        } else {
            write!(f, "{}", Triple(self.0))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every construct of both dialects survives, including those that are written differently.
    #[test]
    fn every_entity_comes_back() {
        let source = "
            v 1 2 3 at 0 0 0 up 0 0 1 angle 45.5 hither 1 resolution 480 640
            view parallel  b 0.1 0.2 0.3 0.5 0.6 1
            l 1 2 3  l 1 2 3 0.5  l 1 2 3 1 0.5 0.25
            f 1 0.5 0.25 0.8 0.2 12.5 0 0
            checker 0.125 1 0 0.5
            s 1e-7 -2 3e20 0.1
            f 1 1 1 1 1 1 1 1 1 5 0.5 0
            f 0.1 0 0 0 1 0 0 0 1 0 0 0.9 1.5
            c 0 0 0 1 0 0 2 0  box 1 1 1 2 3 4
            p 4 0 0 0 1 0 0 1 1 0 0 1 0
            pp 3 0 0 0 0 0 1 1 0 0 0 1 1 0 1 0 0 0 2
            f 0 0 0 0 0 0 0 0 0 0 0 0  checker 2e5 0.1 0.2 0.3 0.4 0.5 0.6";
        let scene = crate::parse(source).unwrap();
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert_eq!(crate::parse(&text).unwrap(), scene, "{text}");
    }

    #[test]
    fn surfaces_out_of_order_are_repeated() {
        let mut scene =
            crate::parse("v 0 0 1 f 1 1 1 1 0 0 0 0 s 0 0 0 1 f 0 0 0 0 0 0 0 0 s 1 1 1 1")
                .unwrap();
        scene.objects.swap(0, 1);
        let mut text = Vec::new();
        write(&scene, &mut text).unwrap();
        let again = crate::parse(std::str::from_utf8(&text).unwrap()).unwrap();
        for (a, b) in scene.objects.iter().zip(&again.objects) {
            assert_eq!(a.shape, b.shape);
            assert_eq!(
                scene.surfaces[a.surface as usize],
                again.surfaces[b.surface as usize]
            );
        }
    }

    #[test]
    fn numbers_are_short_and_exact() {
        for (number, text) in [
            (0.1, "0.1"),
            (512.0, "512"),
            (1e300, "1e300"),
            (-2.5e-9, "-2.5e-9"),
            (0.0, "0"),
        ] {
            assert_eq!(Number(number).to_string(), text);
        }
    }
}
