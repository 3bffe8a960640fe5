//! Words on a sheet, in the chosen language.

use sightline::project::ReportLanguage;

/// The words of a language.
#[derive(Clone, Copy)]
pub struct Words(pub ReportLanguage);

impl Words {
    fn choose(self, english: String, korean: String) -> String {
        match self.0 {
            ReportLanguage::English => english,
            ReportLanguage::Korean => korean,
        }
    }

    /// Codes of a family.
    pub fn codes(self, family: &str, numbers: &[u32]) -> String {
        match numbers {
            [] => family.to_owned(),
            [one] => self.choose(format!("{family} no. {one}"), format!("{family} {one}번")),
            [first, .., last] => {
                self.choose(format!("{family} no. {first} ... {last}"), format!("{family} {first}~{last}번"))
            }
        }
    }

    pub fn bar_ends(self, length: &str) -> String {
        self.choose(format!("ends of scale bars, {length} mm"), format!("축척 막대 양 끝, {length} mm"))
    }

    pub fn bar_end(self, length: &str) -> String {
        self.choose(format!("end of a scale bar, {length} mm"), format!("축척 막대 한쪽 끝, {length} mm"))
    }

    pub fn bars(self, length: &str) -> String {
        self.choose(format!("scale bars, {length} mm"), format!("축척 막대, {length} mm"))
    }

    pub fn dots(self, first: usize, last: usize) -> String {
        self.choose(format!("dots d{first}-d{last}"), format!("코드 없는 점 d{first}~d{last}"))
    }

    /// A sheet of a calibration field, counted from 1 at the top left.
    pub fn field(self, column: u32, row: u32) -> String {
        self.choose(format!("calibration field, column {column} row {row}"), format!("검정판, {column}열 {row}행"))
    }

    pub fn sheet(self, number: usize, count: usize) -> String {
        self.choose(format!("sheet {number} of {count}"), format!("{count}장 중 {number}번째"))
    }

    pub fn print(self) -> String {
        self.choose("print at 100 %, without fitting".into(), "배율 100 %로 인쇄(용지 맞춤 없이)".into())
    }

    pub fn ruler(self) -> String {
        self.choose("ruler, 100 mm: what does it measure?".into(), "자 100 mm: 실제로 재면 얼마입니까?".into())
    }
}
