//! Working in tables: cells that are typed, filled and pasted, rows that are excluded, deleted and renamed; every one a step
//! that can be undone.

use std::collections::BTreeMap;
use std::sync::Arc;

use leptos::prelude::*;
use sightline::adjustment::Criteria;
use sightline::project::Role;
use sightline_exchange as exchange;

use super::{Desk, Selection};
use crate::document::Table;
use crate::document::keys::Kind;
use crate::document::keys::observation_of_key;
use crate::document::{Change, Document};
use crate::edit::cells::{self, CellEdit, Refusal};
use crate::edit::many::{self, RenameFault, RowKeys};
use crate::edit::natural;
use crate::edit::sheet::{Col, Sheet};
use crate::format;
use crate::i18n::{errors, text};

/// Which rows of a table are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Condition {
    #[default]
    All,
    FewRays,
    LargeW,
    Excluded,
    Unnamed,
    Marked,
}

impl Condition {
    /// The conditions that a table's rows can meet.
    pub fn of(table: Table) -> &'static [Self] {
        match table {
            Table::Photos => &[Self::All, Self::Excluded, Self::Marked],
            Table::Points | Table::Control => &[Self::All, Self::FewRays, Self::Excluded, Self::Marked],
            Table::Observations => &[Self::All, Self::LargeW, Self::Excluded, Self::Marked],
            Table::Identities => &[Self::All, Self::Unnamed, Self::Marked],
            Table::Cameras | Table::Distances => &[Self::All, Self::Marked],
        }
    }
}

/// A cell that would change, as the preview shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub cell: CellEdit,
    pub before: String,
    pub refusal: Option<Refusal>,
}

/// Cells pasted, waiting to be taken.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plan {
    pub cells: Vec<Planned>,
    /// Lines that belong to no row.
    pub lost: usize,
}

/// Contents of the tables.
#[derive(Clone, Copy, Default)]
pub struct Tables {
    pub table: RwSignal<Table>,
    pub text: RwSignal<String>,
    pub condition: RwSignal<Condition>,
    pub sorting: RwSignal<Option<(Col, bool)>>,
    /// The column in which the focus is.
    pub col: RwSignal<usize>,
    pub plan: RwSignal<Option<Plan>>,
}

/// Maximum number of pasted cells.
const MOST: usize = 200_000;

impl Desk {
    /// Shows a table from its beginning.
    pub fn show_table(self, table: Table) {
        self.tables.table.set(table);
        self.tables.text.set(String::new());
        self.tables.condition.set(Condition::All);
        self.tables.sorting.set(None);
        self.tables.col.set(0);
        self.tables.plan.set(None);
    }

    /// Criteria of the result; the default ones before there is a result.
    pub fn criteria(self) -> Criteria {
        self.document.with(|d| d.current().map_or_else(Criteria::default, |r| r.adjustment.criteria))
    }

    /// Rows of a sheet that are shown, in their order.
    pub fn shown_rows(self, sheet: &Sheet) -> Vec<u32> {
        let (condition, critical, kind) = (self.tables.condition.get(), self.criteria().w, sheet.table.kind());
        let marked = match condition {
            Condition::Marked => self.selection.with(|s| s.marked(kind).cloned()).unwrap_or_default(),
            _ => RowKeys::new(),
        };
        let meets = |row: usize| match condition {
            Condition::All => true,
            Condition::FewRays => sheet.rays(row) < 3,
            Condition::LargeW => sheet.w(row).is_some_and(|w| w.abs() > critical),
            Condition::Excluded => !sheet.takes_part(row),
            Condition::Unnamed => !sheet.is_named(row),
            Condition::Marked => marked.contains(&sheet.key(row)),
        };
        let mut rows = self.tables.text.with(|text| sheet.filtered(text, meets));
        if let Some((col, descending)) = self.tables.sorting.get() {
            sheet.sort(&mut rows, col, descending);
        }
        rows
    }

    /// Writes the typed text into a cell, or reports why not. Returns whether it was written.
    pub fn set_cell(self, table: Table, cell: CellEdit) -> bool {
        let (after, taken) = self.document.with_untracked(|d| cells::tried(d, table, std::slice::from_ref(&cell)));
        if let Some(Err(refusal)) = taken.into_iter().next() {
            self.warn_here(move || refusal_words(&refusal, &cell.typed));
            return false;
        }
        self.take_cells(table, 1, after);
        if cell.col == Col::Id && table.kind() == Kind::Points {
            let name = cell.typed.trim().to_owned();
            self.selection.update(|s| rename_in(s, &cell.key, &name));
        }
        true
    }

    fn take_cells(self, table: Table, cells: usize, after: Document) {
        if self.document.with_untracked(|d| *d.project == *after.project) {
            return;
        }
        self.change(Change::CellsEdited { table, cells }, |d| *d = after);
    }

    /// Fills the selected cells of a column with the content of the first one.
    pub fn fill_down(self, sheet: &Sheet, rows: &[u32], col: Col) {
        let marked = untrack(|| self.marked(sheet.table.kind()));
        let chosen = rows.iter().filter(|row| marked.contains(&sheet.key(**row as usize))).collect::<Vec<_>>();
        let Some((first, rest)) = chosen.split_first() else { return };
        let typed = sheet.value(**first as usize, col).plain();
        let cell = |row: &&u32| CellEdit { key: sheet.key(**row as usize), col, typed: typed.clone() };
        let cells = rest.iter().map(cell).collect::<Vec<_>>();
        let (after, taken) = self.document.with_untracked(|d| cells::tried(d, sheet.table, &cells));
        let refused = taken.iter().filter_map(|t| t.as_ref().err()).cloned().collect::<Vec<_>>();
        self.take_cells(sheet.table, taken.len() - refused.len(), after);
        if let Some(first) = refused.first().cloned() {
            let count = refused.len();
            self.warn_here(move || text::cells_refused(format::count(count), refusal_words(&first, &typed)));
        }
    }

    /// Lets the marked rows take part or not.
    pub fn switch_rows(self, table: Table, enabled: bool) {
        let keys = untrack(|| self.marked(table.kind()));
        let mut after = self.document.get_untracked();
        let rows = many::switch(after.project_mut(), table, &keys, enabled);
        if rows > 0 {
            self.change(Change::RowsSwitched { table, rows: keys.len(), enabled }, |d| *d = after);
        }
    }

    /// Takes the marked rows out of the project; of targets their names.
    pub fn delete_rows(self, table: Table) {
        let keys = untrack(|| self.marked(table.kind()));
        let mut after = self.document.get_untracked();
        let rows = many::delete(&mut after, table, &keys);
        if rows == 0 {
            return self.tell_here(|| text::nothing_to_delete().to_owned());
        }
        self.change(Change::RowsDeleted { table, rows }, |d| *d = after);
        self.selection.update(|s| {
            s.unmark(table.kind());
            s.target = None;
            if s.point.as_ref().is_some_and(|p| table.kind() == Kind::Points && keys.contains(p)) {
                s.point = None;
            }
        });
        let photo = self.document.with_untracked(|d| d.project.photos.first().map(|p| p.id.clone()));
        if table == Table::Photos {
            self.selection.update(|s| *s = Selection { photo, ..Selection::default() });
        }
    }

    /// Gives the marked points a role.
    pub fn set_roles(self, role: Role) {
        let ids = untrack(|| self.marked(Kind::Points));
        let mut after = self.document.get_untracked();
        let points = many::set_roles(after.project_mut(), &ids, role);
        if points > 0 {
            self.change(Change::RolesSet { points, role }, |d| *d = after);
        }
    }

    /// Makes the marked points one.
    pub fn merge_points(self) {
        let ids = untrack(|| self.marked(Kind::Points));
        let mut after = self.document.get_untracked();
        match many::merge(after.project_mut(), &ids) {
            Err(photo) => self.warn_here(move || text::merge_clash(&photo)),
            Ok(kept) => {
                self.change(Change::PointsMerged { points: ids.len(), into: kept.clone() }, |d| *d = after);
                self.select_point(&kept);
            }
        }
    }

    /// Parts a point: the marked observations of it become a point of their own.
    pub fn split_point(self) {
        let keys = untrack(|| self.marked(Kind::Observations));
        let pairs = keys.iter().filter_map(|key| observation_of_key(key)).collect::<Vec<_>>();
        let points = pairs.iter().map(|(_, point)| *point).collect::<std::collections::BTreeSet<_>>();
        let (Some(point), 1) = (points.first(), points.len()) else {
            return self.warn_here(|| text::split_one_point().to_owned());
        };
        let photos = pairs.iter().map(|(photo, _)| (*photo).to_owned()).collect::<RowKeys>();
        let mut after = self.document.get_untracked();
        let Some(name) = many::split(after.project_mut(), point, &photos) else {
            return self.warn_here(|| text::split_leaves_nothing().to_owned());
        };
        self.change(Change::PointSplit { point: (*point).to_owned(), new: name.clone() }, |d| *d = after);
        self.selection.update(|s| s.unmark(Kind::Observations));
        self.select_point(&name);
    }

    /// Gives the marked points names by a pattern. Whether it could.
    pub fn rename_by_pattern(self, pattern: &str, start: &str) -> bool {
        let mut ids = untrack(|| self.marked(Kind::Points)).into_iter().collect::<Vec<_>>();
        ids.sort_by(|a, b| natural(a, b));
        let start = start.trim().parse().unwrap_or(1);
        self.rename_points(&many::by_pattern(&ids, pattern, start))
    }

    /// Gives the marked points the names of the nearest control points that were read and not taken. Whether it could.
    pub fn rename_by_nearest(self, tolerance: &str) -> bool {
        let Some(tolerance) = format::parse(tolerance).filter(|t| *t > 0.0) else {
            let typed = tolerance.to_owned();
            self.warn_here(move || errors::refusal(&typed, text::not_a_length));
            return false;
        };
        let unit = self.document.with_untracked(|d| d.project.unit.clone());
        let given = self.intake.pasted.with_untracked(|p| p.as_ref().map_or(Ok(Vec::new()), |p| p.points_in(&unit)));
        let given = match given {
            Ok(given) => given,
            Err(error) => {
                self.warn_error(error);
                return false;
            }
        };
        let given = given.into_iter().filter_map(|p| Some((p.id, p.xyz?))).collect::<Vec<_>>();
        let ids = untrack(|| self.marked(Kind::Points));
        let points = self.document.with_untracked(|d| {
            let adjusted = d.current().map(|r| r.adjustment.points.clone()).unwrap_or_default();
            adjusted.into_iter().filter(|p| ids.contains(&p.id)).map(|p| (p.id, p.xyz)).collect::<Vec<_>>()
        });
        let names = many::by_nearest(&points, &given, tolerance);
        if names.is_empty() {
            self.warn_here(|| text::nearest_none().to_owned());
            return false;
        }
        self.rename_points(&names)
    }

    fn rename_points(self, names: &BTreeMap<String, String>) -> bool {
        let mut after = self.document.get_untracked();
        match many::rename_all(after.project_mut(), names) {
            Err(fault) => {
                self.warn_here(move || match &fault {
                    RenameFault::Twice(name) => text::name_twice(name),
                    RenameFault::Taken(name) => text::name_taken(name),
                    RenameFault::Empty => text::name_taken(""),
                });
                false
            }
            Ok(points) => {
                if points > 0 {
                    self.change(Change::PointsRenamed(points), |d| *d = after);
                    self.selection.update(|s| {
                        s.point = s.point.take().map(|p| names.get(&p).cloned().unwrap_or(p));
                        s.mark_all(Kind::Points, names.values().cloned().collect());
                    });
                }
                true
            }
        }
    }

    /// Makes the marked cameras one.
    pub fn join_cameras(self) {
        let ids = untrack(|| self.marked(Kind::Cameras));
        let mut after = self.document.get_untracked();
        let Some(kept) = many::join_cameras(after.project_mut(), &ids) else {
            return self.warn_here(|| text::cameras_differ().to_owned());
        };
        self.change(Change::CamerasJoined { cameras: ids.len(), into: kept.clone() }, |d| *d = after);
        self.selection.update(|s| s.mark_all(Kind::Cameras, [kept].into()));
    }

    /// Plans what pasted rows would change: by the names in their headings, or from the focused cell on.
    pub fn plan_paste(self, sheet: &Sheet, rows: &[u32], pasted: &str, heading: impl Fn(Col) -> String) {
        let from = untrack(|| self.marked(sheet.table.kind()));
        let at = rows.iter().position(|row| from.contains(&sheet.key(*row as usize))).unwrap_or(0);
        let (cells, lost) = read_cells(sheet, rows, (at, self.tables.col.get_untracked()), pasted, heading);
        let cells = cells.into_iter().take(MOST).filter(|(cell, before)| cell.typed.trim() != before.trim());
        let (cells, before): (Vec<_>, Vec<_>) = cells.unzip();
        let (_, taken) = self.document.with_untracked(|d| cells::tried(d, sheet.table, &cells));
        let planned = cells.into_iter().zip(before).zip(taken);
        let cells = planned.map(|((cell, before), taken)| Planned { cell, before, refusal: taken.err() }).collect();
        self.tables.plan.set(Some(Plan { cells, lost }));
    }

    /// Takes the planned cells that can be taken.
    pub fn take_plan(self, table: Table) {
        let Some(plan) = self.tables.plan.get_untracked() else { return };
        let cells = plan.cells.into_iter().filter(|p| p.refusal.is_none()).map(|p| p.cell).collect::<Vec<_>>();
        let (after, taken) = self.document.with_untracked(|d| cells::tried(d, table, &cells));
        self.take_cells(table, taken.iter().filter(|t| t.is_ok()).count(), after);
        self.tables.plan.set(None);
    }
}

fn rename_in(selection: &mut Selection, from: &str, to: &str) {
    if selection.point.as_deref() == Some(from) {
        selection.point = Some(to.to_owned());
    }
    selection.renamed(Kind::Points, from, to);
}

/// Cells of pasted lines with their present contents, and the number of lines without a row.
fn read_cells(
    sheet: &Sheet,
    rows: &[u32],
    (row, col): (usize, usize),
    pasted: &str,
    heading: impl Fn(Col) -> String,
) -> (Vec<(CellEdit, String)>, usize) {
    let columns = sheet.columns();
    let lines = exchange::pasted(pasted);
    let Some(first) = lines.first() else { return (Vec::new(), 0) };
    let named = first.fields.iter().map(|name| columns.iter().copied().find(|col| heading(*col) == *name));
    let named = named.collect::<Vec<_>>();
    let value = |row: usize, col: Col| sheet.value(row, col).plain();
    let (mut cells, mut lost) = (Vec::new(), 0);
    let headed = sheet.table.names().iter().all(|name| named.contains(&Some(*name)));
    if headed {
        let names = sheet.table.names();
        let places = (0..sheet.len()).map(|row| (names.iter().map(|col| value(row, *col)).collect::<Vec<_>>(), row));
        let places = places.collect::<std::collections::HashMap<_, _>>();
        for line in &lines[1..] {
            let part = |col: &Col| {
                let at = named.iter().position(|n| n.as_ref() == Some(col));
                at.and_then(|at| line.fields.get(at)).cloned().unwrap_or_default()
            };
            let Some(&row) = places.get(&names.iter().map(part).collect::<Vec<_>>()) else {
                lost += 1;
                continue;
            };
            for (typed, col) in line.fields.iter().zip(&named) {
                let Some(col) = col.filter(|col| sheet.table.editable(*col) && !names.contains(col)) else { continue };
                cells.push((CellEdit { key: sheet.key(row), col, typed: typed.clone() }, value(row, col)));
            }
        }
    } else {
        for (k, line) in lines.iter().enumerate() {
            let Some(&row) = rows.get(row + k) else {
                lost += 1;
                continue;
            };
            for (typed, col) in line.fields.iter().zip(columns.iter().skip(col)) {
                if sheet.table.editable(*col) || !typed.is_empty() {
                    let key = sheet.key(row as usize);
                    cells.push((CellEdit { key, col: *col, typed: typed.clone() }, value(row as usize, *col)));
                }
            }
        }
    }
    (cells, lost)
}

/// The sentence for a cell that keeps what it has.
pub fn refusal_words(refusal: &Refusal, typed: &str) -> String {
    match refusal {
        Refusal::NoSuchRow => text::refused_no_row().to_owned(),
        Refusal::NotEditable => text::refused_not_editable().to_owned(),
        Refusal::NotANumber => errors::refusal(typed, text::not_a_number),
        Refusal::NotPositive => text::not_a_length(typed),
        Refusal::NotAFlag => text::refused_flag(typed),
        Refusal::NotARole => text::refused_role(typed),
        Refusal::NoName => text::name_taken(typed),
        Refusal::NameTaken => text::name_taken(typed),
        Refusal::NoSuchCamera => text::refused_camera(typed),
        Refusal::NoSuchPoint => text::distance_no_point().to_owned(),
        Refusal::SamePoint => text::distance_same_point().to_owned(),
        Refusal::BothInPhoto(photo) => text::merge_clash(photo),
    }
}

/// A sheet that is shared; two are the same only where they are one.
#[derive(Clone)]
pub struct Shared(pub Arc<Sheet>);

impl PartialEq for Shared {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

#[cfg(test)]
mod tests {
    use sightline::project::{Point, Project};

    use super::*;

    fn document() -> Document {
        let points = ["a", "b", "c"].map(|id| Point { id: id.into(), ..Point::default() }).into();
        Document { project: Arc::new(Project { points, ..Project::default() }), ..Document::default() }
    }

    #[test]
    fn pasted_rows_find_their_places_by_headings_or_from_the_cell_on() {
        let sheet = Sheet::new(Table::Points, &document());
        let heading = |col: Col| format!("{col:?}");
        let typed = |cells: Vec<(CellEdit, String)>| {
            cells.into_iter().map(|(cell, _)| (cell.key, cell.col, cell.typed)).collect::<Vec<_>>()
        };
        let (cells, lost) = read_cells(&sheet, &[0, 1, 2], (0, 0), "Role\tId\ncheck\tc\ncontrol\tz", heading);
        assert_eq!((typed(cells), lost), (vec![("c".into(), Col::Role, "check".into())], 1));
        let (cells, lost) = read_cells(&sheet, &[2, 0], (1, 2), "check\r\ntie\n", heading);
        assert_eq!((typed(cells), lost), (vec![("a".into(), Col::Role, "check".into())], 1));
        let (cells, lost) = read_cells(&sheet, &[0, 1], (0, 0), "#1\tcheck\n\"two words\"\t\n", heading);
        let names = typed(cells).into_iter().map(|cell| cell.2).collect::<Vec<_>>();
        assert_eq!((names, lost), (vec!["#1".into(), "check".into(), "two words".into()], 0));
        assert_eq!(read_cells(&sheet, &[0], (0, 0), "\n \n", heading), (Vec::new(), 0));
    }
}
