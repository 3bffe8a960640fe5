//! Decodes text files: UTF-8, UTF-16 and CP949, recognised by content; lists of points also in Windows-1252 if no other encoding
//! fits.
//!
//! A mark at the beginning decides. Without one, bytes of 0 indicate UTF-16, in the byte order that has more of them where ASCII
//! has its upper byte; what is good UTF-8 is UTF-8; and what is good CP949 and mostly everyday Korean is that, which texts in
//! Western code pages are not.

use crate::reason::ExchangeReason;
use encoding_index_korean::euc_kr::{backward, forward};
use serde::{Deserialize, Serialize};

use sightline::error::{Error, Place, Result};

/// How characters are written as bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub enum Encoding {
    /// UTF-8, with or without a mark.
    #[default]
    #[serde(rename = "utf-8")]
    Utf8,
    /// UTF-16 of either order.
    #[serde(rename = "utf-16")]
    Utf16,
    /// The Korean code page of Windows.
    #[serde(rename = "cp949")]
    Cp949,
    /// The Western code page of Windows.
    #[serde(rename = "windows-1252")]
    Windows1252,
}

/// The text of a file.
///
/// # Errors
/// [`Error::Invalid`] for bytes that are not text, or text in another code page.
pub fn text(bytes: &[u8]) -> Result<String> {
    let found = match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => utf8(rest),
        [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
        [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
        _ if bytes.contains(&0) => unmarked_utf16(bytes),
        _ => utf8(bytes).or_else(|| korean(bytes)),
    };
    found.ok_or(Error::Invalid { reason: ExchangeReason::NotText.into(), at: Place::default() })
}

/// The text of a list with the encoding that it is in, and whether that is certain: what is none of the others may be Windows-1252, which almost any bytes are.
/// `chosen` is used instead of the detected one.
///
/// # Errors
/// [`Error::Invalid`] for bytes that are not text in the chosen encoding, or in any.
pub fn list(bytes: &[u8], chosen: Option<Encoding>) -> Result<(String, Encoding, bool)> {
    let not = Error::Invalid { reason: ExchangeReason::NotText.into(), at: Place::default() };
    if let Some(encoding) = chosen {
        let found = match encoding {
            Encoding::Utf8 => utf8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes)),
            Encoding::Utf16 => match bytes {
                [0xff, 0xfe, rest @ ..] => utf16(rest, u16::from_le_bytes),
                [0xfe, 0xff, rest @ ..] => utf16(rest, u16::from_be_bytes),
                _ => unmarked_utf16(bytes),
            },
            Encoding::Cp949 => cp949(bytes).map(|(text, _)| text),
            Encoding::Windows1252 => western(bytes),
        };
        return found.map(|text| (text, encoding, true)).ok_or(not);
    }
    let marked = matches!(bytes, [0xff, 0xfe, ..] | [0xfe, 0xff, ..]) || bytes.contains(&0);
    match text(bytes) {
        Ok(text) if marked => Ok((text, Encoding::Utf16, true)),
        Ok(text) if std::str::from_utf8(bytes).is_ok() => Ok((text, Encoding::Utf8, true)),
        Ok(text) => Ok((text, Encoding::Cp949, true)),
        Err(_) if marked => Err(not),
        Err(_) => {
            // Letters outweigh the signs before them: Shift-JIS and GBK have lead bytes there, and are not read as nonsense.
            let signs = bytes.iter().filter(|byte| (0x80..0xa0).contains(*byte)).count();
            let letters = bytes.iter().filter(|byte| **byte >= 0xa0).count();
            let found = western(bytes).filter(|_| letters > signs);
            found.map(|text| (text, Encoding::Windows1252, false)).ok_or(not)
        }
    }
}

/// A text in CP949; the first character that it does not have otherwise.
pub fn to_cp949(text: &str) -> std::result::Result<Vec<u8>, char> {
    let mut bytes = Vec::with_capacity(text.len());
    for letter in text.chars() {
        if letter.is_ascii() {
            bytes.push(letter as u8);
            continue;
        }
        let pointer = backward(u32::from(letter));
        if pointer == 0xffff {
            return Err(letter);
        }
        // 190 trails a lead, as in the index of the Encoding Standard.
        bytes.extend([(pointer / 190 + 0x81) as u8, (pointer % 190 + 0x41) as u8]);
    }
    Ok(bytes)
}

/// Windows-1252: Latin-1 with signs at 0x80 to 0x9f; five bytes there mean nothing, and control characters are in no text.
fn western(bytes: &[u8]) -> Option<String> {
    const SIGNS: [char; 32] = [
        '€', '\0', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\0', 'Ž', '\0', '\0', '‘', '’', '“', '”',
        '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\0', 'ž', 'Ÿ',
    ];
    let letter = |byte: u8| match byte {
        b'\t' | b'\n' | b'\r' | 0xc => Some(char::from(byte)),
        0..0x20 | 0x7f => None,
        0x80..0xa0 => Some(SIGNS[usize::from(byte - 0x80)]).filter(|sign| *sign != '\0'),
        _ => Some(char::from(byte)),
    };
    bytes.iter().map(|byte| letter(*byte)).collect()
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
    cp949(bytes).filter(|(_, [everyday, rare])| everyday > rare).map(|(text, _)| text)
}

/// CP949, with how many of its characters are everyday ones, and how many rare.
fn cp949(bytes: &[u8]) -> Option<(String, [usize; 2])> {
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
    Some((text, [everyday, rare]))
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
    fn a_list_says_its_encoding_and_takes_another() {
        let western = b"Punkt;X;Y;H\xf6he\nM\xfcnchen;1,5;2,5;3,5\n\x80;1;2;3\n";
        let (read, encoding, certain) = list(western, None).unwrap();
        assert!(read.contains("Höhe") && read.contains("München") && read.contains('€'), "{read}");
        assert_eq!((encoding, certain), (Encoding::Windows1252, false));
        let korean = to_cp949("점번호,표고\n벽1,㎜\n").unwrap();
        assert_eq!(list(&korean, None).unwrap(), ("점번호,표고\n벽1,㎜\n".into(), Encoding::Cp949, true));
        assert!(list(&korean, Some(Encoding::Utf8)).is_err());
        assert!(list(&korean, Some(Encoding::Windows1252)).unwrap().0.ends_with(",\u{a7}\u{ae}\n"));
        for (bytes, encoding) in [
            (b"a,1".to_vec(), Encoding::Utf8),
            (b"\xef\xbb\xbfa".to_vec(), Encoding::Utf8),
            (units("a,1", u16::to_be_bytes), Encoding::Utf16),
        ] {
            assert_eq!(list(&bytes, None).unwrap().1, encoding);
        }
        // Shift-JIS "点名,高さ" has lead bytes among the signs; zeros that are no UTF-16 are no text.
        for other in [b"\x93\x5f\x96\xbc,\x8d\x82\x82\xb3".as_slice(), b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR", b"a\x01\xe9"] {
            assert!(list(other, None).is_err(), "{other:x?}");
        }
        assert_eq!(to_cp949("a😀"), Err('😀'));
    }

    #[test]
    fn every_letter_of_cp949_comes_back() {
        let all: String = ('\u{a0}'..='\u{ffff}').filter(|letter| to_cp949(&letter.to_string()).is_ok()).collect();
        assert!(all.chars().count() > 17_000, "{}", all.chars().count());
        assert_eq!(list(&to_cp949(&all).unwrap(), Some(Encoding::Cp949)).unwrap().0, all);
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
