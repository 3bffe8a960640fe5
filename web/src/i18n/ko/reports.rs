//! 보고서의 문장.

use super::{Korean, choose};
use crate::i18n::translate;

translate! { Korean reports {
    // Report
    report: "보고서";
    report_sentence: "제출하는 문서입니다. 모든 수치에 단위와 σ 수준을 적습니다.";
    report_figure: "준비됨";
    write_report: "보고서 작성";
    print_or_pdf: "인쇄·PDF 저장";
    save_html: "HTML 저장";
    writing_report: "보고서 작성 중";
    report_settings: "보고서 내용";
    report_preview: "인쇄할 보고서";
    report_sections: "항목";
    section_summary: "요약";
    section_uncertainty: "불확도 (GUM)";
    section_observations: "관측값과 미지수";
    section_network: "관측망";
    section_control: "기준점, 검사점, 축척";
    section_lengths: "길이 측정 오차 (VDI/VDE 2634)";
    section_statistics: "통계와 검정";
    section_left_out: "제외한 관측값";
    section_settings: "설정과 입력 자료";
    section_all_observations: "전체 영상 관측값";
    report_language: "보고서 언어";
    paper_size: "용지";
    first_page: "첫 쪽";
    report_title: "제목 (비우면 프로젝트 이름)";
    measured_by: "측정자";
    date_of_report: "날짜 (비우면 오늘)";
    free_text: "본문";
    choose_logo: "로고 고르기…";
    remove_logo: "로고 삭제";
    logo_kind: "로고는 PNG나 JPEG 파일입니다.";
    logo_size: "그림이 1 MB보다 큽니다. 더 작은 그림을 로고로 고르십시오.";
    statements: "정확도 표기";
    coverage_factor: "포함인자 k";
    limit_constant(unit): "허용 길이 오차 A, {unit}";
    limit_per: "A + L / K의 K";
    limit_hint: "기준점·축척에서 점검용으로 표시한 거리와 비교합니다.";
    check_only: "점검용";
    check_only_means: "결과와 비교만 하고 조정에는 쓰지 않습니다";
    change_report: "보고서 편집";
} }
