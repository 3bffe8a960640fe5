//! Texts of the report.

use super::{English, choose};
use crate::i18n::declare;

declare! { reports {
    // Report
    report: "Report";
    report_sentence: "The document to hand over. Every number has its unit and sigma level.";
    report_figure: "ready";
    write_report: "Write report";
    print_or_pdf: "Print or save PDF";
    save_html: "Save HTML";
    writing_report: "Writing the report";
    report_settings: "Report contents";
    report_preview: "Report as it is printed";
    report_sections: "Sections";
    section_summary: "Summary";
    section_uncertainty: "Uncertainty (GUM)";
    section_observations: "Observations and unknowns";
    section_network: "Network";
    section_control: "Control, check points, scale";
    section_lengths: "Length errors (VDI/VDE 2634)";
    section_statistics: "Statistics and tests";
    section_left_out: "Rejected observations";
    section_settings: "Settings and inputs";
    section_all_observations: "All image observations";
    report_language: "Language of the report";
    paper_size: "Paper";
    first_page: "First page";
    report_title: "Title (empty: project name)";
    measured_by: "Measured by";
    date_of_report: "Date (empty: today)";
    free_text: "Text";
    choose_logo: "Choose logo…";
    remove_logo: "Remove logo";
    logo_kind: "A logo must be a PNG or JPEG file.";
    logo_size: "This picture is larger than 1 MB. Choose a smaller logo.";
    statements: "Accuracy statements";
    coverage_factor: "Coverage factor k";
    limit_constant(unit): "Permitted length error A, {unit}";
    limit_per: "K of A + L / K";
    limit_hint: "Compared with the distances marked as check only under Control, scale.";
    check_only: "check only";
    check_only_means: "Compared with the result, not used in the adjustment";
    change_report: "report edited";
} }
