//! The simulated panel: pictures of it, and a live window.

use super::overlay;
use crate::PanelJob;
use embedded_graphics::Pixel;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Size};
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::primitives::Rectangle;
use embedded_graphics_simulator::{OutputSettings, OutputSettingsBuilder, SimulatorDisplay};
use octray_embedded::dither::PanelColor;
use octray_render::error::Error;
use octray_render::interrupt::Interrupt;
use octray_render::picture::{Picture, Target};
use std::fs;
use std::path::PathBuf;

/// A panel that is shown after each strip that is drawn on it.
pub(crate) struct Screen<'a, C> {
    display: SimulatorDisplay<C>,
    settings: OutputSettings,
    interrupt: &'a Interrupt,
    frames: Option<Frames>,
    #[cfg(feature = "window")]
    window: embedded_graphics_simulator::Window,
}

/// Pictures, one for each strip.
struct Frames {
    folder: PathBuf,
    count: u32,
}

impl<'a, C: PanelColor + Into<Rgb888> + From<Rgb888>> Screen<'a, C> {
    /// A black panel.
    ///
    /// # Errors
    /// [`Error::Write`] if the folder for frames cannot be made.
    pub(crate) fn new(job: &PanelJob, interrupt: &'a Interrupt) -> Result<Self, Error> {
        if let Some(folder) = &job.frames {
            fs::create_dir_all(folder).map_err(|source| Error::write(folder, source))?;
        }
        let settings = OutputSettingsBuilder::new().scale(job.scale).build();
        let size = Size::new(job.panel.0, job.panel.1);
        let display = SimulatorDisplay::with_default_color(size, Rgb888::BLACK.into());
        Ok(Self {
            display,
            interrupt,
            frames: job.frames.clone().map(|folder| Frames { folder, count: 0 }),
            #[cfg(feature = "window")]
            window: embedded_graphics_simulator::Window::new("octray", &settings),
            settings,
        })
    }

    /// Draws a line of text over the bottom.
    ///
    /// # Errors
    /// As drawing a strip does.
    pub(crate) fn overlay(&mut self, text: &str) -> Result<(), Error> {
        let Ok(()) = overlay::draw(&mut self.display, text);
        self.shown()
    }

    /// What the panel shows, its pixels scaled.
    ///
    /// # Errors
    /// [`Error::Failed`] if there is not enough memory.
    pub(crate) fn picture(&self) -> Result<Picture, Error> {
        let image = self.display.to_rgb_output_image(&self.settings);
        let size = image.size();
        let levels = image.as_image_buffer().pixels().map(|rgb| rgb.0).collect();
        Picture::from_levels(size.width, size.height, levels)
            .ok_or_else(|| Error::Failed("the picture of the panel is incomplete".into()))
    }

    /// Shows the finished panel until its window is closed.
    ///
    /// # Errors
    /// [`Error::Interrupted`].
    #[cfg(feature = "window")]
    pub(crate) fn wait(self) -> Result<(), Error> {
        while !self.closed() {
            self.interrupt.check()?;
            std::thread::sleep(std::time::Duration::from_millis(20));
        }
        Ok(())
    }

    /// Nothing to wait for.
    #[cfg(not(feature = "window"))]
    pub(crate) fn wait(self) -> Result<(), Error> {
        Ok(())
    }

    /// Shows what has been drawn.
    fn shown(&mut self) -> Result<(), Error> {
        self.interrupt.check()?;
        if let Some(frames) = &mut self.frames {
            frames.count += 1;
            let name = format!("frame-{:04}.png", frames.count);
            let target = Target::new(frames.folder.join(name)).map_err(Error::Failed)?;
            target.write(&self.picture()?, Default::default(), self.interrupt)?;
        }
        #[cfg(feature = "window")]
        {
            self.window.update(&self.display);
            if self.closed() {
                return Err(Error::Interrupted);
            }
        }
        Ok(())
    }

    #[cfg(feature = "window")]
    fn closed(&self) -> bool {
        use embedded_graphics_simulator::SimulatorEvent;
        self.window
            .events()
            .any(|event| event == SimulatorEvent::Quit)
    }
}

impl<C> OriginDimensions for Screen<'_, C> {
    fn size(&self) -> Size {
        self.display.size()
    }
}

impl<C: PanelColor + Into<Rgb888> + From<Rgb888>> DrawTarget for Screen<'_, C> {
    type Color = C;
    type Error = Error;

    fn draw_iter<I: IntoIterator<Item = Pixel<C>>>(&mut self, pixels: I) -> Result<(), Error> {
        let Ok(()) = self.display.draw_iter(pixels);
        Ok(())
    }

    fn fill_contiguous<I: IntoIterator<Item = C>>(
        &mut self,
        area: &Rectangle,
        colours: I,
    ) -> Result<(), Error> {
        let Ok(()) = self.display.fill_contiguous(area, colours);
        self.shown()
    }
}
