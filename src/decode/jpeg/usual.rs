//! The standard Huffman tables of T.81, annex K.3, which some files omit, such as frames of films.

/// Numbers of codes of each length for direct coefficients, of luma and of chroma; their symbols are 0 to 11.
const DIRECT: [[u8; 16]; 2] =
    [[0, 1, 5, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0], [0, 3, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0]];
/// The same for alternating coefficients, with the symbols of codes of less than 16 bits; the others follow by value.
const ALTERNATING: [([u8; 16], &[u8]); 2] = [
    (
        [0, 2, 1, 3, 3, 2, 4, 3, 5, 5, 4, 4, 0, 0, 1, 125],
        &[
            0x01, 0x02, 0x03, 0x00, 0x04, 0x11, 0x05, 0x12, 0x21, 0x31, 0x41, 0x06, 0x13, 0x51, 0x61, 0x07, 0x22, 0x71,
            0x14, 0x32, 0x81, 0x91, 0xa1, 0x08, 0x23, 0x42, 0xb1, 0xc1, 0x15, 0x52, 0xd1, 0xf0, 0x24, 0x33, 0x62, 0x72,
            0x82,
        ],
    ),
    (
        [0, 2, 1, 2, 4, 4, 3, 4, 7, 5, 4, 4, 0, 1, 2, 119],
        &[
            0x00, 0x01, 0x02, 0x03, 0x11, 0x04, 0x05, 0x21, 0x31, 0x06, 0x12, 0x41, 0x51, 0x07, 0x61, 0x71, 0x13, 0x22,
            0x32, 0x81, 0x08, 0x14, 0x42, 0x91, 0xa1, 0xb1, 0xc1, 0x09, 0x23, 0x33, 0x52, 0xf0, 0x15, 0x62, 0x72, 0xd1,
            0x0a, 0x16, 0x24, 0x34, 0xe1, 0x25, 0xf1,
        ],
    ),
];

/// A segment that defines them: 0 and 1 of either kind.
pub fn segment() -> Vec<u8> {
    let mut segment = Vec::new();
    for (place, counts) in (0u8..).zip(DIRECT) {
        segment.push(place);
        segment.extend(counts);
        segment.extend(0..12);
    }
    for (place, (counts, first)) in (0x10u8..).zip(ALTERNATING) {
        segment.push(place);
        segment.extend(counts);
        segment.extend(first);
        let is_symbol = |symbol: &u8| (1..=10).contains(&(symbol & 15)) && !first.contains(symbol);
        segment.extend((0..=255).filter(is_symbol));
    }
    segment
}
