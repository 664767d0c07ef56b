//! Cutting a picture into packets of rows that threads write into without getting in each other's way.

use crate::picture::{Intensity, Level, Picture};
use std::num::NonZeroU32;
use std::ops::Range;
use std::sync::Mutex;

/// The rows of one packet, whole rows of the picture from column 0.
#[derive(Debug)]
pub struct Packet<'a> {
    /// Which rows of the picture these are.
    pub rows: Range<u32>,
    /// Their levels.
    pub levels: &'a mut [Level],
    /// Their intensities, if the picture has them.
    pub intensities: Option<&'a mut [Intensity]>,
}

/// All packets of a picture, each to be taken once by whichever thread works on it.
#[derive(Debug)]
pub struct Packets<'a>(Vec<Mutex<Option<Packet<'a>>>>);

impl<'a> Packets<'a> {
    /// Cut `rows` of a picture into packets of `height` rows, from the top; the last one may be lower.
    /// Rows that the picture does not have are left out.
    pub fn cut(picture: &'a mut Picture, rows: Range<u32>, height: NonZeroU32) -> Self {
        let (width, end) = (picture.width() as usize, rows.end.min(picture.height()));
        let (mut levels, mut intensities) = picture.pixels_mut();
        let mut packets = Vec::new();
        let mut start = rows.start.min(end);
        take(&mut levels, start as usize * width);
        take_some(&mut intensities, start as usize * width);
        while start < end {
            let stop = start.saturating_add(height.get()).min(end);
            let pixels = (stop - start) as usize * width;
            packets.push(Mutex::new(Some(Packet {
                rows: start..stop,
                levels: take(&mut levels, pixels),
                intensities: take_some(&mut intensities, pixels),
            })));
            start = stop;
        }
        Self(packets)
    }

    /// How many packets there are.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Take a packet; `None` if it was taken before or is not there.
    pub fn take(&self, index: usize) -> Option<Packet<'a>> {
        self.0.get(index)?.lock().ok()?.take()
    }
}

/// Cut the first `count` elements (or all there are) off a slice.
fn take<'a, T>(slice: &mut &'a mut [T], count: usize) -> &'a mut [T] {
    slice
        .split_off_mut(..count.min(slice.len()))
        .unwrap_or_default()
}

fn take_some<'a, T>(slice: &mut Option<&'a mut [T]>, count: usize) -> Option<&'a mut [T]> {
    slice.as_mut().map(|slice| take(slice, count))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interrupt::Interrupt;
    use crate::schedule::{Schedule, run_packets};
    use clap::ValueEnum;
    use std::num::NonZeroUsize;

    /// A picture whose every pixel holds its row and column, made packet by packet.
    fn paint(rows: Range<u32>, height: u32, schedule: Schedule) -> Picture {
        let mut picture = Picture::black(5, 23, true).unwrap();
        let packets = Packets::cut(&mut picture, rows, NonZeroU32::new(height).unwrap());
        run_packets(
            packets.len(),
            NonZeroUsize::new(3).unwrap(),
            schedule,
            &Interrupt::new(),
            |_| (),
            |(), index| {
                let packet = packets.take(index).unwrap();
                let intensities = packet.intensities.unwrap();
                assert_eq!(packet.levels.len(), packet.rows.len() * 5);
                assert_eq!(intensities.len(), packet.levels.len());
                let places = packet
                    .rows
                    .flat_map(|row| (0..5).map(move |column| (row, column)));
                for ((row, column), level) in places.zip(packet.levels) {
                    *level = [row as u8, column, 1];
                }
            },
            || {},
        )
        .unwrap();
        assert!(packets.take(0).is_none());
        picture
    }

    #[test]
    fn packets_cover_their_rows_and_nothing_else() {
        for schedule in Schedule::value_variants() {
            for height in [1, 4, 23, 1000] {
                for rows in [0..23, 0..1, 7..20, 22..23, 20..99, 30..99, 5..5] {
                    let picture = paint(rows.clone(), height, *schedule);
                    for (row, levels) in (0..).zip(picture.rows()) {
                        for (column, level) in (0..).zip(levels) {
                            let painted = [row as u8, column, 1];
                            let expected = if rows.contains(&row) { painted } else { [0; 3] };
                            assert_eq!(*level, expected, "{rows:?} {height}");
                        }
                    }
                }
            }
        }
    }
}
