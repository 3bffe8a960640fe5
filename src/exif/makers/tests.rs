#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use super::*;
use Aberration::{Diffraction, Distortion, LateralColour, Vignetting};
use Setting::{Auto, Off, On};

fn bytes(value: u32, width: usize, little: bool) -> Vec<u8> {
    if little { value.to_le_bytes()[..width].to_vec() } else { value.to_be_bytes()[4 - width..].to_vec() }
}

/// Tag, type, values.
type Given = (u16, u16, Vec<u32>);

/// A directory at offset `at` of the block; its offsets are relative to `base`.
fn directory(entries: &[Given], at: usize, base: usize, little: bool) -> Vec<u8> {
    let after = at + 2 + 12 * entries.len() + 4;
    let (mut table, mut data) = (bytes(entries.len() as u32, 2, little), Vec::new());
    for (tag, kind, values) in entries {
        let width = match kind {
            3 => 2,
            4 | 9 | 13 => 4,
            _ => 1,
        };
        let mut value: Vec<u8> = values.iter().flat_map(|value| bytes(*value, width, little)).collect();
        table.extend(bytes(u32::from(*tag), 2, little));
        table.extend(bytes(u32::from(*kind), 2, little));
        table.extend(bytes(values.len() as u32, 4, little));
        if value.len() <= 4 {
            value.resize(4, 0);
            table.extend(value);
        } else {
            table.extend(bytes((after + data.len() - base) as u32, 4, little));
            data.extend(value);
        }
    }
    table.extend([0; 4]);
    [table, data].concat()
}

/// Something before the note, as there is in every file.
const AT: usize = 50;

/// The block with a note of this head; `own` counts its places from so far into it, or from the block.
fn block(head: &[u8], own: Option<usize>, entries: &[Given], little: bool) -> Vec<u8> {
    let base = own.map_or(0, |own| AT + own);
    let mut block = vec![0xee; AT];
    block.extend(head);
    block.extend(directory(entries, AT + head.len(), base, little));
    block
}

fn read(block: &[u8], little: bool, make: &str) -> Says {
    let all = corrections(block, AT, little, make);
    all.into_iter().map(|found| (found.aberration, found.setting, found.tag)).collect()
}

fn expected(list: &[(Aberration, Setting, &str)]) -> Says {
    list.iter().map(|(aberration, setting, tag)| (*aberration, *setting, (*tag).to_owned())).collect()
}

type Says = Vec<(Aberration, Setting, String)>;

/// Notes of all makers in a byte order: block, maker, contents.
fn notes(little: bool) -> Vec<(Vec<u8>, &'static str, Says)> {
    let other: Given = (0x0001, 2, b"0130 and so on".iter().map(|c| u32::from(*c)).collect());
    let order: &[u8] = if little { b"II" } else { b"MM" };
    let sony = [other.clone(), (0x2011, 4, vec![2]), (0x2012, 4, vec![u32::MAX]), (0x2013, 4, vec![0])];
    let sony_says = expected(&[(Vignetting, Auto, "Sony 0x2011"), (Distortion, Off, "Sony 0x2013")]);
    let nikon_head = [b"Nikon\0\x02\x10\0\0", order, &bytes(42, 2, little), &bytes(8, 4, little)[..]].concat();
    let nikon = [
        (0x002a, 3, vec![3]),
        (0x002b, 7, [&b"0100"[..], &[1, 0, 0, 0]].concat().into_iter().map(u32::from).collect()),
        other.clone(),
    ];
    let canon = [
        (0x4016, 9, vec![40, 1, 2, 3, 4, 1, 0, 1, 0, 0]),
        (0x4018, 9, [&[48, 0, 0, 0, 0, 0, 0, 0, 0, 0][..], &[2, 0]].concat()),
    ];
    let pentax_head = [b"PENTAX \0", order].concat();
    let olympus_head = [b"OLYMPUS\0", order, b"\x03\0"].concat();
    // its directories below: one by its place, one as the value itself
    let mut olympus = vec![0xee; AT];
    olympus.extend(&olympus_head);
    let settings = AT + 12 + 2 + 2 * 12 + 4;
    let below = directory(&[(0x050b, 3, vec![0]), (0x050c, 3, vec![1])], settings, AT, little);
    let processing = directory(&[(0x1011, 3, vec![1]), (0x1012, 3, vec![0])], settings + below.len(), AT, little);
    let place = |at: usize| bytes((at - AT) as u32, 4, little);
    olympus.extend(bytes(2, 2, little));
    olympus.extend([bytes(0x2020, 2, little), bytes(13, 2, little), bytes(1, 4, little), place(settings)].concat());
    let size = bytes(processing.len() as u32, 4, little);
    olympus.extend([bytes(0x2040, 2, little), bytes(7, 2, little), size, place(settings + below.len())].concat());
    olympus.extend([0; 4]);
    olympus.extend(&below);
    olympus.extend(&processing);
    vec![
        (block(b"SONY DSC \0\0\0", None, &sony, little), "SONY", sony_says.clone()),
        (block(b"", None, &sony, little), "SONY", sony_says),
        (
            block(&nikon_head, Some(10), &nikon, little),
            "NIKON CORPORATION",
            expected(&[(Vignetting, On, "Nikon 0x002a"), (Distortion, On, "Nikon 0x002b")]),
        ),
        (
            block(b"", None, &canon, little),
            "Canon",
            expected(&[
                (Vignetting, On, "Canon 0x4016"),
                (LateralColour, Off, "Canon 0x4016"),
                (Distortion, On, "Canon 0x4016"),
                (Vignetting, Off, "Canon 0x4018"),
                (Diffraction, On, "Canon 0x4018"),
            ]),
        ),
        (
            block(&pentax_head, Some(0), &[(0x007d, 1, vec![1, 0, 1, 16])], little),
            "RICOH IMAGING COMPANY, LTD.",
            expected(&[
                (Distortion, On, "Pentax 0x007d"),
                (LateralColour, Off, "Pentax 0x007d"),
                (Vignetting, On, "Pentax 0x007d"),
                (Diffraction, On, "Pentax 0x007d"),
            ]),
        ),
        (
            block(b"Panasonic\0\0\0", None, &[other, (0x008a, 3, vec![1])], little),
            "Panasonic",
            expected(&[(Vignetting, On, "Panasonic 0x008a")]),
        ),
        (
            olympus,
            "OLYMPUS CORPORATION",
            expected(&[
                (Distortion, Off, "Olympus 0x050b"),
                (Vignetting, On, "Olympus 0x050c"),
                (Distortion, On, "Olympus 0x1011"),
                (Vignetting, Off, "Olympus 0x1012"),
            ]),
        ),
    ]
}

#[test]
fn the_settings_of_every_maker_are_read_in_both_byte_orders() {
    for little in [true, false] {
        for (block, make, says) in notes(little) {
            assert_eq!(read(&block, little, make), says, "{make}");
        }
    }
    // Fujifilm's is little-endian in whatever block it is
    let head = [&b"FUJIFILM"[..], &[12, 0, 0, 0]].concat();
    let fuji = block(&head, Some(0), &[(0x1045, 4, vec![1])], true);
    assert_eq!(read(&fuji, false, "FUJIFILM"), expected(&[(Diffraction, On, "Fujifilm 0x1045")]));
}

#[test]
fn values_that_are_not_known_and_other_makers_say_nothing() {
    for value in [1, 3, 255, u32::MAX] {
        assert_eq!(read(&block(b"", None, &[(0x2013, 4, vec![value])], true), true, "SONY"), []);
    }
    for value in [2, 16, 255] {
        assert_eq!(read(&block(b"PENTAX \0II", Some(0), &[(0x007d, 1, vec![value])], true), true, "PENTAX"), []);
    }
    let sony = block(b"", None, &[(0x2013, 4, vec![2])], true);
    for make in ["", "Apple", "Google", "samsung"] {
        assert_eq!(read(&sony, true, make), []);
    }
}

#[test]
fn damaged_notes_say_less_and_never_more() {
    for little in [true, false] {
        for (block, make, says) in notes(little) {
            for end in 0..block.len() {
                let read = read(&block[..end], little, make);
                assert!(read.iter().all(|found| says.contains(found)), "{make} cut at {end}");
            }
            // Changed at any place, reading must end, with any result.
            for at in 0..block.len() {
                for value in [0x00, 0x01, 0x7f, 0xff] {
                    let mut changed = block.clone();
                    changed[at] = value;
                    read(&changed, little, make);
                }
            }
        }
    }
    assert_eq!(corrections(&[], 0, true, "SONY"), []);
    assert_eq!(corrections(&[0; 4], usize::MAX - 3, true, "Canon"), []);
}
