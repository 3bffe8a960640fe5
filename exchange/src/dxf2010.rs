//! Drawings for CAD as ASCII DXF of release 2010 (AC1024) in UTF-8: layers have the project's names in any script, and `$INSUNITS` has the unit.
//!
//! Content as in [`super::dxf`]. Layers have true colours beside the nearest of the numbered ones. What such a file must have is there and no
//! more: tables with the records that readers ask for, the two spaces as blocks, the root dictionary; every object has a handle and its owner.
//!
//! Source: Autodesk, "DXF Reference", AutoCAD 2010.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;

use super::dxf::{Entity, index, items, number, pair, place, title};
use super::spatial::Spatial;
use sightline::adjustment::Adjustment;
use sightline::project::Project;
use sightline::units::Unit;

/// Handles that others refer to; those of layers and entities follow.
const MODEL_SPACE: &str = "10";
const PAPER_SPACE: &str = "11";
const LAYERS: &str = "2";
const ROOT: &str = "C";

/// Code of `$INSUNITS`; 0 for a unit that is not known.
fn insunits(unit: Option<Unit>) -> u8 {
    match unit {
        None => 0,
        Some(Unit::Inch) => 1,
        Some(Unit::Foot) => 2,
        Some(Unit::Millimetre) => 4,
        Some(Unit::Centimetre) => 5,
        Some(Unit::Metre) => 6,
        Some(Unit::Kilometre) => 7,
        Some(Unit::Yard) => 10,
        Some(Unit::Micrometre) => 13,
        Some(Unit::Decimetre) => 14,
        Some(Unit::SurveyFoot) => 21,
    }
}

/// A text on one line.
fn plain(words: &str) -> String {
    // A caret and what follows is a control character there.
    words.chars().map(|c| if c.is_control() { ' ' } else { c }).collect::<String>().replace('^', "^ ")
}

/// Layers with their names in the drawing, unique regardless of case, and colours.
#[derive(Default)]
struct LayerTable {
    names: BTreeMap<String, (String, [u8; 3])>,
    taken: BTreeSet<String>,
}

impl LayerTable {
    fn named(&mut self, name: &str, colour: [u8; 3]) -> String {
        if let Some((known, _)) = self.names.get(name) {
            return known.clone();
        }
        // These are not in names of a release 2010.
        let letter = |c: char| if c.is_control() || "<>/\\\":;?*|=`,".contains(c) { '_' } else { c };
        let plain: String = name.trim().chars().map(letter).take(200).collect();
        let plain = if plain.is_empty() { "_".to_owned() } else { plain };
        let mut own = plain.clone();
        let mut count = 1;
        while own == "0" || !self.taken.insert(own.to_lowercase()) {
            count += 1;
            own = format!("{plain}_{count}");
        }
        self.names.insert(name.to_owned(), (own.clone(), colour));
        own
    }
}

/// Text with running handles.
struct Writer {
    text: String,
    handle: u32,
}

impl Writer {
    fn pair(&mut self, code: u32, value: &str) {
        pair(&mut self.text, code, value);
    }

    fn next(&mut self) -> String {
        self.handle += 1;
        format!("{:X}", self.handle)
    }

    /// Begins an object of a class under an owner.
    fn object(&mut self, kind: &str, handle: &str, owner: &str) {
        self.pair(0, kind);
        self.pair(if kind == "DIMSTYLE" { 105 } else { 5 }, handle);
        self.pair(330, owner);
    }

    /// Begins a record of a table.
    fn record(&mut self, kind: &str, handle: &str, owner: &str, class: &str, name: &str) {
        self.object(kind, handle, owner);
        self.pair(100, "AcDbSymbolTableRecord");
        self.pair(100, class);
        self.pair(2, name);
    }

    fn table(&mut self, kind: &str, handle: &str, count: usize) {
        self.pair(0, "TABLE");
        self.pair(2, kind);
        self.pair(5, handle);
        self.pair(330, "0");
        self.pair(100, "AcDbSymbolTable");
        self.pair(70, &count.to_string());
    }

    /// Begins an entity of model space.
    fn entity(&mut self, kind: &str, layer: &str, class: &str) {
        let handle = self.next();
        self.object(kind, &handle, MODEL_SPACE);
        self.pair(100, "AcDbEntity");
        self.pair(8, layer);
        self.pair(100, class);
    }
}

/// The drawing.
pub fn write(project: &Project, adjustment: Option<&Adjustment>) -> String {
    let spatial = Spatial::of(project, adjustment);
    let text_height = 0.008 * spatial.size;
    let items = items(project, &spatial, text_height);
    let mut layers = LayerTable::default();
    let names: Vec<String> = items.iter().map(|item| layers.named(&item.layer, item.colour)).collect();
    let mut w = Writer { text: String::new(), handle: 0x100 };
    let first = w.handle;

    let mut body = Writer { text: String::new(), handle: first + 0x10 + layers.names.len() as u32 };
    for (item, layer) in items.iter().zip(&names) {
        match &item.shape {
            Entity::Point(at) => {
                body.entity("POINT", layer, "AcDbPoint");
                place(&mut body.text, 10, *at);
            }
            Entity::Line(from, to) => {
                body.entity("LINE", layer, "AcDbLine");
                place(&mut body.text, 10, *from);
                place(&mut body.text, 11, *to);
            }
            Entity::Text(at, words) => {
                body.entity("TEXT", layer, "AcDbText");
                place(&mut body.text, 10, *at);
                body.pair(40, &number(text_height));
                body.pair(1, &plain(words));
                body.pair(100, "AcDbText");
            }
        }
    }

    w.pair(999, &plain(&title(project)));
    w.text.push_str("0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1024\n9\n$DWGCODEPAGE\n3\nANSI_1252\n");
    let _ = writeln!(w.text, "9\n$INSUNITS\n70\n{}", insunits(Unit::named(&project.unit)));
    let _ = writeln!(w.text, "9\n$MEASUREMENT\n70\n{}", u8::from(insunits(Unit::named(&project.unit)) > 2));
    let half = spatial.size / 2.0;
    for (name, sign) in [("$EXTMIN", -1.0), ("$EXTMAX", 1.0)] {
        w.pair(9, name);
        place(&mut w.text, 10, spatial.centre.map(|c| c + sign * half));
    }
    w.text.push_str("9\n$PDMODE\n70\n2\n9\n$PDSIZE\n40\n");
    let _ = writeln!(w.text, "{}", number(0.005 * spatial.size));
    let _ = writeln!(w.text, "9\n$HANDSEED\n5\n{:X}\n0\nENDSEC", body.handle + 1);
    w.text.push_str("0\nSECTION\n2\nCLASSES\n0\nENDSEC\n");

    w.text.push_str("0\nSECTION\n2\nTABLES\n");
    w.table("VPORT", "8", 0);
    w.pair(0, "ENDTAB");
    w.table("LTYPE", "5", 3);
    for (handle, name) in [("14", "ByBlock"), ("15", "ByLayer"), ("16", "Continuous")] {
        w.record("LTYPE", handle, "5", "AcDbLinetypeTableRecord", name);
        w.text.push_str("70\n0\n3\n\n72\n65\n73\n0\n40\n0.0\n");
    }
    w.pair(0, "ENDTAB");
    w.table("LAYER", LAYERS, layers.names.len() + 1);
    let base = ("0".to_owned(), [0; 3]);
    for (name, colour) in std::iter::once(&base).chain(layers.names.values()) {
        let handle = w.next();
        w.record("LAYER", &handle, LAYERS, "AcDbLayerTableRecord", name);
        w.pair(70, "0");
        w.pair(62, &index(*colour).to_string());
        if *colour != [0; 3] {
            let [r, g, b] = colour.map(u32::from);
            w.pair(420, &(r << 16 | g << 8 | b).to_string());
        }
        w.text.push_str("6\nContinuous\n370\n-3\n390\nF\n");
    }
    w.pair(0, "ENDTAB");
    w.table("STYLE", "3", 1);
    w.record("STYLE", "12", "3", "AcDbTextStyleTableRecord", "Standard");
    w.text.push_str("70\n0\n40\n0.0\n41\n1.0\n50\n0.0\n71\n0\n42\n2.5\n3\nArial.ttf\n4\n\n");
    w.pair(0, "ENDTAB");
    w.table("VIEW", "6", 0);
    w.pair(0, "ENDTAB");
    w.table("UCS", "7", 0);
    w.pair(0, "ENDTAB");
    w.table("APPID", "9", 1);
    w.record("APPID", "13", "9", "AcDbRegAppTableRecord", "ACAD");
    w.pair(70, "0");
    w.pair(0, "ENDTAB");
    w.table("DIMSTYLE", "A", 1);
    w.pair(100, "AcDbDimStyleTable");
    w.record("DIMSTYLE", "17", "A", "AcDbDimStyleTableRecord", "Standard");
    w.pair(70, "0");
    w.pair(0, "ENDTAB");
    w.table("BLOCK_RECORD", "1", 2);
    for (handle, name, layout) in [(MODEL_SPACE, "*Model_Space", "1A"), (PAPER_SPACE, "*Paper_Space", "1B")] {
        w.record("BLOCK_RECORD", handle, "1", "AcDbBlockTableRecord", name);
        w.pair(340, layout);
        w.text.push_str("70\n0\n280\n1\n281\n0\n");
    }
    w.pair(0, "ENDTAB");
    w.pair(0, "ENDSEC");

    w.text.push_str("0\nSECTION\n2\nBLOCKS\n");
    for (owner, name, begin, end) in
        [(MODEL_SPACE, "*Model_Space", "20", "21"), (PAPER_SPACE, "*Paper_Space", "22", "23")]
    {
        w.object("BLOCK", begin, owner);
        w.text.push_str("100\nAcDbEntity\n8\n0\n100\nAcDbBlockBegin\n");
        let _ = writeln!(w.text, "2\n{name}\n70\n0\n10\n0.0\n20\n0.0\n30\n0.0\n3\n{name}\n1\n");
        w.object("ENDBLK", end, owner);
        w.text.push_str("100\nAcDbEntity\n8\n0\n100\nAcDbBlockEnd\n");
    }
    w.pair(0, "ENDSEC");

    w.text.push_str("0\nSECTION\n2\nENTITIES\n");
    w.text.push_str(&body.text);
    w.pair(0, "ENDSEC");

    w.text.push_str("0\nSECTION\n2\nOBJECTS\n");
    let dictionary = |w: &mut Writer, handle: &str, owner: &str, entries: &[(&str, &str)]| {
        w.object("DICTIONARY", handle, owner);
        w.text.push_str("100\nAcDbDictionary\n281\n1\n");
        for (name, entry) in entries {
            w.pair(3, name);
            w.pair(350, entry);
        }
    };
    dictionary(&mut w, ROOT, "0", &[("ACAD_GROUP", "D"), ("ACAD_LAYOUT", "1C"), ("ACAD_PLOTSTYLENAME", "E")]);
    dictionary(&mut w, "D", ROOT, &[]);
    dictionary(&mut w, "1C", ROOT, &[("Model", "1A"), ("Layout1", "1B")]);
    w.object("ACDBDICTIONARYWDFLT", "E", ROOT);
    w.text.push_str("100\nAcDbDictionary\n281\n1\n3\nNormal\n350\nF\n100\nAcDbDictionaryWithDefault\n340\nF\n");
    w.object("ACDBPLACEHOLDER", "F", "E");
    for (handle, name, order, space) in [("1A", "Model", 0, MODEL_SPACE), ("1B", "Layout1", 1, PAPER_SPACE)] {
        w.object("LAYOUT", handle, "1C");
        w.text.push_str("100\nAcDbPlotSettings\n1\n\n2\nnone_device\n4\n\n6\n\n");
        for code in [40, 41, 42, 43, 44, 45, 46, 47, 48, 49, 140, 141] {
            w.pair(code, "0.0");
        }
        let _ = writeln!(
            w.text,
            "142\n1.0\n143\n1.0\n70\n{}\n72\n0\n73\n0\n74\n5\n7\n\n75\n16\n147\n1.0\n148\n0.0\n149\n0.0",
            if order == 0 { 1024 } else { 0 }
        );
        w.pair(100, "AcDbLayout");
        w.pair(1, name);
        let _ = writeln!(w.text, "70\n1\n71\n{order}");
        w.text.push_str("10\n0.0\n20\n0.0\n11\n420.0\n21\n297.0\n12\n0.0\n22\n0.0\n32\n0.0\n14\n0.0\n24\n0.0\n34\n0.0\n15\n0.0\n25\n0.0\n35\n0.0\n146\n0.0\n13\n0.0\n23\n0.0\n33\n0.0\n16\n1.0\n26\n0.0\n36\n0.0\n17\n0.0\n27\n1.0\n37\n0.0\n76\n0\n");
        w.pair(330, space);
    }
    w.pair(0, "ENDSEC");
    w.pair(0, "EOF");
    w.text
}
