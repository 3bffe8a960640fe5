//! Writes HTML: text is escaped on insertion, so that a photo's name cannot become a tag.

use std::fmt::Write;

/// Text as it stands between tags and in quoted attributes.
pub fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            // Control characters have no form in HTML.
            c if c.is_control() && c != '\n' && c != '\t' => safe.push('\u{fffd}'),
            c => safe.push(c),
        }
    }
    safe
}

/// A section in the making.
#[derive(Default)]
pub struct Html {
    text: String,
}

impl Html {
    /// Written contents.
    pub fn finish(self) -> String {
        self.text
    }

    /// Puts in what is HTML already.
    pub fn raw(&mut self, html: &str) -> &mut Self {
        self.text.push_str(html);
        self
    }

    /// An element with text.
    pub fn element(&mut self, tag: &str, class: &str, text: &str) -> &mut Self {
        self.open(tag, class).raw(&escaped(text)).close(tag)
    }

    /// A paragraph.
    pub fn p(&mut self, text: &str) -> &mut Self {
        self.element("p", "", text)
    }

    /// A remark in smaller print.
    pub fn note(&mut self, text: &str) -> &mut Self {
        self.element("p", "note", text)
    }

    /// A heading within a section.
    pub fn h3(&mut self, text: &str) -> &mut Self {
        self.element("h3", "", text)
    }

    /// A list of sentences.
    pub fn list(&mut self, items: &[String]) -> &mut Self {
        self.open("ul", "");
        for item in items {
            self.element("li", "", item);
        }
        self.close("ul")
    }

    /// Begins an element.
    pub fn open(&mut self, tag: &str, class: &str) -> &mut Self {
        let class = if class.is_empty() { String::new() } else { format!(" class=\"{class}\"") };
        // Writing to a String does not fail.
        let _ = write!(self.text, "<{tag}{class}>");
        self
    }

    /// Ends an element.
    pub fn close(&mut self, tag: &str) -> &mut Self {
        let _ = writeln!(self.text, "</{tag}>");
        self
    }

    /// Puts in a table, unless it has no rows.
    pub fn table(&mut self, table: Table) -> &mut Self {
        table.write(&mut self.text);
        self
    }

    /// Names with their values.
    pub fn pairs(&mut self, pairs: &[(String, String)]) -> &mut Self {
        self.open("table", "pairs whole").open("tbody", "");
        for (name, value) in pairs {
            let _ = writeln!(self.text, "<tr><th scope=\"row\">{}</th><td>{}</td></tr>", escaped(name), escaped(value));
        }
        self.close("tbody").close("table")
    }
}

/// Content of a column.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ColumnKind {
    Number,
    Words,
}

/// A table with its head.
pub struct Table {
    columns: Vec<(String, ColumnKind)>,
    rows: Vec<(Vec<String>, &'static str)>,
    class: &'static str,
}

/// Maximum number of rows of a table that stands on one page.
const WHOLE: usize = 12;

impl Table {
    /// A table without columns yet.
    pub fn new() -> Self {
        Self { columns: Vec::new(), rows: Vec::new(), class: "" }
    }

    /// Smaller print, for many columns.
    pub fn dense(mut self) -> Self {
        self.class = "dense";
        self
    }

    /// A column of names or words.
    pub fn words(mut self, head: &str) -> Self {
        self.columns.push((escaped(head), ColumnKind::Words));
        self
    }

    /// A column of numbers.
    pub fn number(mut self, head: &str) -> Self {
        self.columns.push((escaped(head), ColumnKind::Number));
        self
    }

    /// A column of numbers whose head has a low letter and a unit.
    pub fn low(mut self, head: &str, low: &str, unit: &str) -> Self {
        let unit =
            if unit.is_empty() { String::new() } else { format!(" <span class=\"unit\">{}</span>", escaped(unit)) };
        let low = if low.is_empty() { String::new() } else { format!("<sub>{}</sub>", escaped(low)) };
        self.columns.push((format!("{}{low}{unit}", escaped(head)), ColumnKind::Number));
        self
    }

    /// A row of plain text.
    pub fn row(&mut self, cells: Vec<String>) {
        self.row_of("", cells);
    }

    /// A row of a class: sums, what is over a limit.
    pub fn row_of(&mut self, class: &'static str, cells: Vec<String>) {
        debug_assert_eq!(cells.len(), self.columns.len());
        self.rows.push((cells, class));
    }

    /// Whether there is nothing in it.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    fn write(self, text: &mut String) {
        if self.rows.is_empty() {
            return;
        }
        let whole = if self.rows.len() <= WHOLE { " whole" } else { "" };
        let class = |kind: ColumnKind| if kind == ColumnKind::Words { " class=\"words\"" } else { "" };
        let _ = write!(text, "<table class=\"data{whole} {}\"><thead><tr>", self.class);
        for (head, kind) in &self.columns {
            // A heading without words is none, for readers of screens too.
            let _ = match head.is_empty() {
                true => write!(text, "<td{}></td>", class(*kind)),
                false => write!(text, "<th scope=\"col\"{}>{head}</th>", class(*kind)),
            };
        }
        text.push_str("</tr></thead><tbody>\n");
        for (cells, row_class) in &self.rows {
            let row = if row_class.is_empty() { String::new() } else { format!(" class=\"{row_class}\"") };
            let _ = write!(text, "<tr{row}>");
            for (cell, (_, kind)) in cells.iter().zip(&self.columns) {
                let _ = write!(text, "<td{}>{}</td>", class(*kind), escaped(cell));
            }
            text.push_str("</tr>\n");
        }
        text.push_str("</tbody></table>\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[cfg(target_arch = "wasm32")]
    use wasm_bindgen_test::wasm_bindgen_test as test;

    #[test]
    fn names_cannot_become_tags() {
        let mut table = Table::new().words("photo").low("σ", "X", "m<m");
        table.row(vec!["<img src=x onerror=\"a\">&\u{7}".into(), "1".into()]);
        let mut html = Html::default();
        html.table(table);
        let text = html.finish();
        assert!(
            !text.contains("<img") && text.contains("&lt;img src=x onerror=&quot;a&quot;&gt;&amp;\u{fffd}"),
            "{text}"
        );
        assert!(text.contains("σ<sub>X</sub> <span class=\"unit\">m&lt;m</span>"));
    }
}
