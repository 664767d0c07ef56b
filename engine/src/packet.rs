//! Parts of a picture to be written into.

use octray_core::frame::Region;

/// Red, green and blue in 8 bits, 255 being full intensity.
pub type Level = [u8; 3];

/// Red, green and blue as linear intensities, 1 being full intensity.
pub type Intensity = [f32; 3];

/// One packet, to be written into.
#[derive(Debug)]
pub struct Packet<'a> {
    /// Which pixels of the picture these are.
    pub region: Region,
    /// Their levels, row by row, as many as the region has pixels.
    pub levels: &'a mut [Level],
    /// As many intensities, if the picture has them.
    pub intensities: Option<&'a mut [Intensity]>,
}
