//! How a list was read, in words: its columns and every assumption.

use sightline::axes::ShownAxes;
use sightline::project::LocalSystem;
use sightline_exchange::control_csv::{
    AngleForm, Assumption, Axes, Basis, Beside, Decimal, Field as ControlField, ListFormat, Separator,
};
use sightline_exchange::encoding::Encoding;

use crate::format;
use crate::i18n::{lists, text};

/// Possible contents of a column, for its menu.
pub(super) fn field_word(axes: ShownAxes, field: ControlField) -> String {
    let [x, y, z] = [0, 1, 2].map(|axis| axes.letter(axis));
    match field {
        ControlField::Id => lists::column_id().to_owned(),
        ControlField::Label => lists::column_label().to_owned(),
        ControlField::X => lists::column_x(x),
        ControlField::Y => lists::column_y(y),
        ControlField::Z => lists::column_z(z),
        ControlField::Latitude => lists::column_latitude().to_owned(),
        ControlField::Longitude => lists::column_longitude().to_owned(),
        ControlField::Sx => format!("σ {x}"),
        ControlField::Sy => format!("σ {y}"),
        ControlField::Sz => format!("σ {z}"),
        ControlField::Sxy => lists::column_sigma_xy(x, y),
        ControlField::Sigma => lists::column_sigma().to_owned(),
        ControlField::Role => lists::column_role().to_owned(),
        ControlField::Diameter => lists::column_diameter().to_owned(),
    }
}

/// A column in a sentence.
fn column_name(axes: ShownAxes, field: ControlField) -> String {
    match field {
        ControlField::X => axes.letter(0).to_owned(),
        ControlField::Y => axes.letter(1).to_owned(),
        ControlField::Z => axes.letter(2).to_owned(),
        ControlField::Latitude | ControlField::Longitude | ControlField::Sx | ControlField::Sy | ControlField::Sz => {
            field_word(axes, field)
        }
        ControlField::Sxy => format!("σ {}, {}", axes.letter(0), axes.letter(1)),
        other => other.name().to_owned(),
    }
}

fn format_word(format: ListFormat) -> &'static str {
    match format {
        ListFormat::Table => "",
        ListFormat::LeicaGsi => "Leica GSI",
        ListFormat::SokkiaSdr => "Sokkia SDR",
        ListFormat::JobXml => "Trimble JobXML",
        ListFormat::LandXml => "LandXML",
        ListFormat::OdmGcp => lists::odm(),
    }
}

fn encoding_word(encoding: Encoding) -> &'static str {
    match encoding {
        Encoding::Utf8 => "UTF-8",
        Encoding::Utf16 => "UTF-16",
        Encoding::Cp949 => "CP949",
        Encoding::Windows1252 => "Windows-1252",
    }
}

/// An assumption as a sentence, if there is one.
pub(super) fn assumption_words(axes: ShownAxes, assumption: &Assumption) -> Option<String> {
    Some(match assumption {
        Assumption::Format { format, .. } => lists::read_format(format_word(*format)),
        Assumption::Encoding { by: Basis::Given, .. } => return None,
        Assumption::Encoding { encoding, by: Basis::Convention } => {
            lists::read_encoding_assumed(encoding_word(*encoding))
        }
        Assumption::Encoding { encoding, .. } => lists::read_encoding(encoding_word(*encoding)),
        Assumption::FirstRow { line, .. } => lists::read_from_line(line),
        Assumption::NamesMade { count } => lists::names_made(format::count(*count)),
        Assumption::Beside { what, count } => {
            let count = format::count(*count);
            match what {
                Beside::LinesBefore => lists::left_lines(count),
                Beside::Measurements => lists::left_measurements(count),
                Beside::ImageMeasurements => lists::left_image_measurements(count),
                Beside::Deleted => lists::left_deleted(count),
                Beside::References => lists::left_references(count),
                Beside::Geographic => lists::left_geographic(count),
            }
        }
        Assumption::Separator { separator, .. } => text::read_separator(match separator {
            Separator::Comma => text::separator_comma(),
            Separator::Semicolon => text::separator_semicolon(),
            Separator::Tab => text::separator_tab(),
            Separator::Blanks => text::separator_blanks(),
        }),
        Assumption::DecimalSign { by: Basis::Undecided | Basis::Convention, .. } => return None,
        Assumption::DecimalSign { sign: Decimal::Point, .. } => text::read_point().to_owned(),
        Assumption::DecimalSign { sign: Decimal::Comma, .. } => text::read_comma().to_owned(),
        Assumption::Columns { columns, by } => {
            let name =
                |column: &Option<ControlField>| column.map_or("–".to_owned(), |field| column_name(axes, field));
            let names = columns.iter().map(name).collect::<Vec<_>>().join(", ");
            match by {
                Basis::Heading => text::read_columns(names),
                // The menus show it.
                Basis::Given => return None,
                _ => text::read_columns_assumed(names),
            }
        }
        Assumption::AxisOrder { by: Basis::Undecided, .. } => return None,
        Assumption::AxisOrder { order: Axes::Xy, .. } => lists::read_east_first().to_owned(),
        Assumption::AxisOrder { order: Axes::Yx, .. } => lists::read_north_first().to_owned(),
        Assumption::LocalSystem { system, form, height_unit, by } => {
            let LocalSystem { latitude, longitude, height, .. } = *system;
            let form = match form {
                AngleForm::Degrees => lists::angles_degrees(),
                AngleForm::Sexagesimal => lists::angles_sexagesimal(),
            };
            let [latitude, longitude, height] = [latitude, longitude, height].map(format::editable);
            let origin = match by {
                Basis::Given => lists::local_origin_given(),
                _ => lists::local_origin_own(),
            };
            let said = lists::read_local_system(form, height_unit.symbol(), latitude, longitude, height);
            format!("{said} {origin}")
        }
        Assumption::Unit { unit: Some(unit), .. } => lists::in_unit(unit.symbol()),
        Assumption::CommonSigma { by: Basis::Undecided, .. } => lists::sigma_needs_unit().to_owned(),
        Assumption::CommonSigma { points, .. } => lists::sigma_given(format::count(*points)),
        Assumption::Ignored { columns } => text::read_ignored(columns.join(", ")),
        Assumption::Remarks { headings } => text::read_remarks(headings.join(", ")),
        Assumption::SigmaColumns { .. } | Assumption::Unit { .. } => return None,
    })
}
