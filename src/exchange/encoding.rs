//! Texts of any editor and spreadsheet as characters: UTF-8, UTF-16 and CP949, told apart by what is in them.
//!
//! A mark at the beginning decides. Without one, bytes of 0 speak for UTF-16, in the order that has more of them where ASCII
//! has its upper byte; what is good UTF-8 is UTF-8; and what is good CP949 and mostly everyday Korean is that, which texts in
//! Western code pages are not.

use encoding_index_korean::euc_kr::forward;

use crate::error::{Error, Place, Reason, Result};

/// The text of a file.
///
/// # Errors
/// [`Error::Invalid`] for what is no text, or one in another code page.
pub fn text(bytes: &[u8]) -> Result<String> {
    let found = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => utf8(rest),
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        _ if bytes.contains(&0) => unmarked_utf16(bytes),
        _ => utf8(bytes).or_else(|| korean(bytes)),
    };
    found.ok_or(Error::Invalid { reason: Reason::NotText, at: Place::default() })
}

fn utf8(bytes: &[u8]) -> Option<String> {
    std::str::from_utf8(bytes).ok().map(str::to_owned)
}

fn utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Option<String> {
    let (pairs, rest) = bytes.as_chunks::<2>();
    let text = char::decode_utf16(pairs.iter().map(|pair| unit(*pair))).collect::<std::result::Result<_, _>>();
    text.ok().filter(|_| rest.is_empty())
}

/// UTF-16 by its ASCII: digits, separators and ends of lines have a byte of 0. The other byte of a letter is 0 now and then
/// ("가" is U+AC00), control characters other than blanks are not in a text.
fn unmarked_utf16(bytes: &[u8]) -> Option<String> {
    let (pairs, _) = bytes.as_chunks::<2>();
    let zeros = |k: usize| pairs.iter().filter(|pair| pair[k] == 0).count();
    let (first, second) = (zeros(0), zeros(1));
    if 4 * first.max(second) < pairs.len() {
        return None;
    }
    let text = utf16(bytes, if first > second { u16::from_be_bytes } else { u16::from_le_bytes })?;
    let strange = |c: char| c.is_control() && !matches!(c, '\t' | '\n' | '\r' | '\u{c}');
    (!text.chars().any(strange)).then_some(text)
}

/// CP949 where the 2350 everyday syllables and the symbols of KS X 1001 outweigh its rare ones: "Größe" in a Western code page is good
/// CP949 too, with a Chinese character in it.
fn korean(bytes: &[u8]) -> Option<String> {
    let (mut everyday, mut rare) = (0, 0);
    let mut text = String::with_capacity(bytes.len() + bytes.len() / 2);
    let mut rest = bytes.iter();
    while let Some(&lead) = rest.next() {
        if lead.is_ascii() {
            text.push(char::from(lead));
            continue;
        }
        let trail = *rest.next()?;
        // The index of the Encoding Standard: 190 trails a lead, 0xffff where there is no character.
        let pointer =
            |lead: u8, trail: u8| Some(u16::from(lead.checked_sub(0x81)?) * 190 + u16::from(trail.checked_sub(0x41)?));
        let unit = Some(trail).filter(|trail| *trail < 0xff).and_then(|trail| pointer(lead, trail)).map(forward)?;
        text.push(char::from_u32(unit).filter(|_| unit != 0xffff)?);
        let known = trail >= 0xa1 && matches!(lead, 0xa1..=0xac | 0xb0..=0xc8);
        *if known { &mut everyday } else { &mut rare } += 1;
    }
    (everyday > rare).then_some(text)
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    const TABLE: &str = "점번호\tX (㎜)\tY\tZ\r\n기준점 가\t1.5\t-2\t3\r\n";

    fn units(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
        text.encode_utf16().flat_map(bytes).collect()
    }

    #[test]
    fn one_table_in_every_encoding() {
        let little = units(TABLE, u16::to_le_bytes);
        let big = units(TABLE, u16::to_be_bytes);
        let korean =
            b"\xc1\xa1\xb9\xf8\xc8\xa3\tX (\xa7\xae)\tY\tZ\r\n\xb1\xe2\xc1\xd8\xc1\xa1 \xb0\xa1\t1.5\t-2\t3\r\n"
                .to_vec();
        for bytes in [
            TABLE.as_bytes().to_vec(),
            [b"\xef\xbb\xbf", TABLE.as_bytes()].concat(),
            [b"\xff\xfe", little.as_slice()].concat(),
            [b"\xfe\xff", big.as_slice()].concat(),
            little,
            big,
            korean,
        ] {
            assert_eq!(text(&bytes).unwrap(), TABLE, "{:x?}", &bytes[..6]);
        }
        assert_eq!(text(b"").unwrap(), "");
    }

    #[test]
    fn plain_numbers_are_read_in_both_orders() {
        for plain in ["1,2,3\n", "a"] {
            assert_eq!(text(&units(plain, u16::to_le_bytes)).unwrap(), plain);
            assert_eq!(text(&units(plain, u16::to_be_bytes)).unwrap(), plain);
        }
    }

    #[test]
    fn what_is_something_else_is_refused() {
        for other in [
            b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x08\0".as_slice(),
            b"PK\x03\x04\x14\0\0\0\x08\0",
            b"\xff\xfe1\0,",
            b"\xff\xfe\0\xd8,\0",
            // Western code pages.
            b"H\xf6he,1,2,3",
            b"Gr\xf6\xdfe,1,2,3",
            b"id,X [\xb5m]",
            b"Stra\xdfe,1,2,3",
            // Cut in the middle of a character, and no character.
            b"\xc1\xa1\xb9\xf8\xc8",
            b"\xc1\xa1\xc9\xff",
            b"\xe4a",
        ] {
            assert_eq!(text(other).unwrap_err().code(), "invalid", "{other:x?}");
        }
    }
}
