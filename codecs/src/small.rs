//! Small pictures out of large ones.

/// Width and height with the same proportions, neither beyond `max_side`.
pub fn fitted([width, height]: [u32; 2], max_side: u32) -> [u32; 2] {
    let longest = u64::from(width.max(height)).max(1);
    let limit = u64::from(max_side.max(1)).min(longest);
    [width, height].map(|side| ((u64::from(side) * limit + longest / 2) / longest).max(1) as u32)
}

/// Means over the pixels that each one of a smaller picture covers; `colour` gives red, green and blue of one of the larger.
pub fn reduced(size: [u32; 2], max_side: u32, colour: impl Fn(usize, usize) -> [u8; 3]) -> ([u32; 2], Vec<u8>) {
    let small = fitted(size, max_side);
    let edge = |at: u32, axis: usize| (u64::from(at) * u64::from(size[axis]) / u64::from(small[axis])) as usize;
    let mut rgba = Vec::with_capacity(4 * small[0] as usize * small[1] as usize);
    for row in 0..small[1] {
        let rows = edge(row, 1)..edge(row + 1, 1);
        for column in 0..small[0] {
            let columns = edge(column, 0)..edge(column + 1, 0);
            let (mut sums, mut count) = ([0u32; 3], 0);
            // three places a side tell as much as all
            for y in rows.clone().step_by((rows.len() / 3).max(1)) {
                for x in columns.clone().step_by((columns.len() / 3).max(1)) {
                    colour(x, y).iter().zip(&mut sums).for_each(|(level, sum)| *sum += u32::from(*level));
                    count += 1;
                }
            }
            rgba.extend(sums.map(|sum| (sum / count.max(1)) as u8));
            rgba.push(255);
        }
    }
    (small, rgba)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_picture_keeps_the_proportions_and_the_colours() {
        let (size, rgba) = reduced([400, 300], 40, |x, _| if x < 200 { [200, 100, 0] } else { [0, 0, 50] });
        assert_eq!((size, rgba.len()), ([40, 30], 4 * 40 * 30));
        assert_eq!((&rgba[..4], &rgba[4 * 39..4 * 40]), (&[200, 100, 0, 255][..], &[0, 0, 50, 255][..]));
        let (size, rgba) = reduced([3, 2], 100, |x, y| [x as u8, y as u8, 9]);
        assert_eq!((size, &rgba[20..]), ([3, 2], &[2, 1, 9, 255][..]));
        assert_eq!(fitted([9000, 1], 100), [100, 1]);
    }
}
