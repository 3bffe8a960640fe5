//! Texts of the report.

use super::{English, choose};
use crate::i18n::declare;

declare! { reports {
    // Report
    report: "Report";
    report_sentence: "The page set that is handed over. Every number has its unit and sigma level.";
    report_figure: "ready";
    write_report: "Write report";
    print_or_pdf: "Print or save PDF";
    save_html: "Save HTML";
    writing_report: "Writing the report";
    report_settings: "What the report has";
    report_preview: "Report as it is printed";
    report_sections: "Sections";
    section_summary: "Summary";
    section_uncertainty: "Uncertainty (GUM)";
    section_observations: "Observations and unknowns";
    section_network: "Network";
    section_control: "Control, check points, scale";
    section_lengths: "Length errors (VDI/VDE 2634)";
    section_statistics: "Statistics and tests";
    section_left_out: "Left out, and why";
    section_settings: "Settings and inputs";
    section_all_observations: "All image observations";
    report_language: "Language of the report";
    paper_size: "Paper";
    first_page: "First page";
    report_title: "Title (else the project’s name)";
    measured_by: "Measured by";
    date_of_report: "Date (else today)";
    free_text: "Text";
    choose_logo: "Choose logo…";
    remove_logo: "Remove logo";
    logo_kind: "A logo is a PNG or JPEG file.";
    logo_size: "This picture is larger than 1 MB: take a smaller one as a logo.";
    statements: "Statements of accuracy";
    coverage_factor: "Coverage factor k";
    limit_constant(unit): "Permitted length error A, {unit}";
    limit_per: "K of A + L / K";
    limit_hint: "Compared with the distances that are marked as check only under control and scale.";
    check_only: "check only";
    check_only_means: "Compared with the result, takes no part in the adjustment";
    change_report: "report edited";
} }
