//! Memory that one thread writes, apart from all else.

/// How far apart: two cache lines, as processors fetch them in pairs.
const LINES: usize = 128;

/// Values that no cache line shares with anything else on the heap. Otherwise a scene that happens to lie beside what
/// another thread writes at every ray is fetched again at every ray: with two threads figure 21 took 7 % longer when
/// started from some folders and not from others.
#[derive(Debug)]
pub(crate) struct CachePadded<T> {
    /// The values, and as many before and behind them as fill the lines.
    all: Vec<T>,
    padding: usize,
}

impl<T: Clone> CachePadded<T> {
    /// So many equal values.
    pub(crate) fn new(value: T, count: usize) -> Self {
        let padding = LINES.div_ceil(size_of::<T>().max(1));
        Self {
            all: vec![value; count + 2 * padding],
            padding,
        }
    }

    /// The values.
    pub(crate) fn get(&mut self) -> &mut [T] {
        let end = self.all.len() - self.padding;
        &mut self.all[self.padding..end]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_values_are_as_many_as_asked_for_and_far_from_both_ends() {
        for count in [0, 1, 7] {
            let mut apart = CachePadded::new(3_u16, count);
            assert_eq!(apart.get(), vec![3; count]);
            let (first, start) = (apart.all.as_ptr() as usize, apart.get().as_ptr() as usize);
            assert!(start - first >= LINES);
            let behind = (apart.all.len() - apart.padding - count) * size_of::<u16>();
            assert!(behind >= LINES);
        }
    }
}
