//! A baked scene and the renderer that suits it.

/// Rows of the strip of a baked scene's renderer.
pub const ROWS: usize = crate::render::ROWS as usize;

/// Declares a module that holds the scene of a name that the build script has baked, and adds `Renderer`, the type of the
/// renderer that suits it.
///
/// ```ignore
/// octray_embedded::scene! { mod figure = "figure-22"; }
///
/// let mut renderer = figure::Renderer::new();
/// renderer.draw(&figure::FRAME, &figure::TRACER, &mut display)?;
/// ```
#[macro_export]
macro_rules! scene {
    ($(#[$attribute:meta])* $visible:vis mod $module:ident = $name:literal;) => {
        $(#[$attribute])*
        #[allow(dead_code, unreachable_pub, reason = "for any program")]
        $visible mod $module {
            include!(concat!(env!("OUT_DIR"), "/", $name, ".rs"));

            /// Renders the scene: it owns the memory for rays, the walk through the tree, the shadow cache and a strip
            /// of four rows.
            pub type Renderer = $crate::Renderer<
                S,
                <Tree as accel::Accelerator<S, FEATURES>>::Stack,
                RAYS,
                LIGHTS,
                { WIDTH as usize * $crate::scene::ROWS },
            >;
        }
    };
}
