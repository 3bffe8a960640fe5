//! The words of the experiments. The engine names columns, figures and lines by identifiers; here they get their words.

use super::texts;

// The pages
texts! {
    experiments: "Experiments", "실험";
    experiments_words: "Three papers from Korea, run again: their networks simulated and adjusted here, their figures beside ours.",
        "한국 논문 세 편을 다시 실행합니다. 논문의 망을 모의하고 조정하여 논문의 수치와 나란히 보입니다.";
    running: "Running the experiment", "실험 실행 중";
    run: "Run", "실행";
    run_again: "Run again", "다시 실행";
    open_as_project: "Open as a project", "프로젝트로 열기";
    not_run_yet: "Run the experiment to see its figures. It takes a few seconds in the background; the page stays usable.",
        "실행하면 수치가 나타납니다. 배경에서 몇 초 걸리며 그동안 페이지를 계속 쓸 수 있습니다.";
    inputs_changed: "The inputs have changed since the last run: run again to see the figures that belong to them.",
        "마지막 실행 뒤에 입력이 바뀌었습니다. 다시 실행하면 새 입력의 수치가 나타납니다.";
    ran_in(seconds): "run in {seconds} s", "{seconds} s에 실행";
    vary: "What may be varied", "바꿀 수 있는 값";
    network: "Network", "망";
    drawing_shown: "network drawn", "그린 망";
    plan: "plan", "평면";
    elevation: "elevation", "입면";
    assumed: "Assumed here", "여기서 가정한 것";
    assumed_aside: "not printed in the paper, or printed otherwise", "논문에 없거나 다르게 적힌 것";
    ours: "ours", "여기";
    paper: "paper", "논문";
    paper_of(what): "{what}, paper", "{what}, 논문";
    independent: "independent", "독립 계산";
    difference: "difference", "차이";
    figure: "figure", "항목";
    figures: "Figures", "수치";
    no_paper_figure: "not printed", "논문에 없음";
    rows(n): "{n} rows", "{n}행";
}

// Questions, one an experiment
texts! {
    kang: "Kang & Yeu 1985", "강준묵·유복모 1985";
    kang_question: "How much do more photos improve coordinates?", "사진을 더 찍으면 좌표가 얼마나 정확해지는가?";
    kang_source: "Kang, J. M. and Yeu, B. M. (1985), A Study on the 3 Dimensional Precision Analysis of Objects by means of Multiple Close Range Photogrammetry.",
        "강준묵, 유복모 (1985), 다중 근거리사진측정에 의한 피사체의 3차원 정밀해석에 관한 연구.";
    film: "Film", "필름";
    film_question: "What do fiducial marks and a distortion table make of comparator readings?", "지표와 왜곡 보정표는 좌표측정기의 읽음값을 얼마나 바로잡는가?";
    film_source: "The way of Kang and Yeu (1985), figures 3-2 and 3-3, on readings made up here.", "강준묵·유복모 (1985) 그림 3-2, 3-3의 절차를 여기서 만든 읽음값에 적용합니다.";
    lee_calibration: "Lee 1996, calibration", "이진덕 1996, 자체검정";
    lee_calibration_question: "How well does a camera calibrate itself, from the pixels on?", "카메라는 화소에서 출발하여 스스로를 얼마나 잘 검정하는가?";
    lee_source: "Lee, J. D. (1996), Effective Application of Close-Range Photogrammetry with Digital Images in Industrial Precise Measurement.",
        "이진덕 (1996), 산업정밀측정에서 수치영상을 이용한 근접사진측량의 효율적 응용.";
    lee_structure: "Lee 1996, structure", "이진덕 1996, 구조물";
    lee_structure_question: "What do convergent photos and a free network give?", "수렴 촬영과 자유망은 무엇을 더해 주는가?";
    kim: "Kim, Hwang & Yun 2015", "김혁길·황진상·윤홍식 2015";
    kim_question: "How near does a pair of photos come, from DLT to intersected points?", "사진 두 매는 DLT에서 전방교회까지 얼마나 정확한가?";
    kim_source: "Kim, H. G., Hwang, J. S. and Yun, H. S. (2015), Accuracy Analysis of 3D Position of Close-range Photogrammetry Using Direct Linear Transformation and Self-calibration Bundle Adjustment with Additional Parameters.",
        "김혁길, 황진상, 윤홍식 (2015), DLT와 부가변수에 의한 광속조정법을 활용한 근접사진측량의 3차원 위치정확도 분석.";
}

// Plates of one's own
texts! {
    plates: "Plates of your own", "내 건판으로";
    plates_words: "Describe camera, fiducial marks and distortion table, one a line; then take readings: photo, mark or point, x, y in the machine's millimetres.",
        "카메라, 지표, 왜곡 보정표를 한 줄에 하나씩 적고 읽음값(사진, 지표 또는 점, x, y, 기계 좌표 mm)을 가져오십시오.";
    plates_description: "description of camera and plates", "카메라와 건판 설명";
    plates_files: "Readings from files…", "파일에서 읽음값…";
    plates_scans: "Measured in the scans", "스캔에서 측정한 값";
    plates_scans_words: "In scanned photos: point at marks and points under Targets, name the marks as above under Identities, then return here.",
        "스캔 사진: 표적 단계에서 지표와 점을 찍고, 점번호 단계에서 지표를 위와 같은 이름으로 지정한 뒤 여기로 돌아오십시오.";
    plates_reduced(photos, observations) [photo = photos "photo" "photos", observation = observations "observation" "observations"]: "{photos} {photo} reduced, {observations} {observation}.", "사진 {photos}매 변환, 관측 {observations}개.";
}

// Inputs
texts! {
    in_distance: "object distance", "촬영거리";
    in_mixed: "mixed distances", "여러 거리 혼합";
    in_combination: "combination", "조합";
    in_photos: "number of photos", "사진 매수";
    in_overlap: "overlap", "중복도";
    in_network: "network of the project", "프로젝트의 망";
    in_datum: "datum of the project", "프로젝트의 기준계";
    in_image_sigma: "σ of image coordinates, µm", "사진좌표 σ, µm";
    in_control_sigma: "σ of control coordinates, mm", "기준점 좌표 σ, mm";
    in_pixel_noise: "noise of the pixels, % of full scale", "화소 잡음, 최댓값의 %";
    in_rounds: "rounds of Monte Carlo", "몬테카를로 횟수";
    in_seed: "seed of the noise", "잡음 시드";
    in_method: "centres adjusted", "조정할 중심";
    in_left_out: "photos left out of the second run", "두 번째 조정에서 뺄 사진";
    left_out_hint: "numbers, separated by blanks", "번호를 빈칸으로 구분";
}

// What a name in a cell, on an axis or after a figure says
texts! {
    all: "all", "전체";
    reduced: "without the photos left out", "사진을 뺀 뒤";
    control: "control", "기준점";
    free: "free network", "자유망";
    observed: "observed", "관측값";
    unknown: "unknown", "미지수";
    yes: "yes", "예";
    no: "no", "아니요";
    greatest: "greatest", "최대";
    least: "least", "최소";
    mean: "mean", "평균";
    standard_deviation: "standard deviation", "표준편차";
    rms: "rms", "RMS";
    similarity: "similarity", "상사변환";
    affine: "affine", "아핀변환";
    projective: "projective", "투영변환";
    similarity_corrected: "similarity, lens corrected", "상사변환, 왜곡 보정";
    affine_corrected: "affine, lens corrected", "아핀변환, 왜곡 보정";
    projective_corrected: "projective, lens corrected", "투영변환, 왜곡 보정";
    field: "test field", "시험장";
    planes: "two planes", "두 평면";
    all_photos: "all photos", "전체 사진";
}

// What identifiers of tables and charts say
texts! {
    t_single: "60 networks at one distance", "한 거리의 망 60개";
    t_mixed: "16 networks of mixed distances", "여러 거리를 섞은 망 16개";
    t_improvement: "Fall of M₀ and Mₛ against two photos", "사진 2매에 대한 M₀, Mₛ의 감소";
    t_pairwise: "Models pair by pair (coplanarity) and the bundle", "공면조건 모델 쌍과 광속조정";
    t_fiducials: "Residuals at the fiducial marks", "지표의 잔차";
    t_transformations: "Parameters of the transformations", "변환 계수";
    t_distortion: "Distortion table and odd polynomial", "왜곡 보정표와 기수차 다항식";
    t_reductions: "What the bundle makes of each reduction", "보정 방법별 광속조정 결과";
    t_photos: "Residuals photo by photo", "사진별 잔차";
    t_parameters: "Camera parameters", "카메라 매개변수";
    t_estimators: "Centres against the truth, best first", "참값과 비교한 표적 중심, 좋은 순";
    t_standard_errors: "Standard errors", "표준오차";
    t_free_gain: "Gain of the free network", "자유망의 향상률";
    t_check_points: "Check points, photogrammetry minus survey", "검사점, 사진측량 − 측량";
    t_statistics: "Statistics of the differences", "차이의 통계";
    t_orientation: "Exterior orientation", "외부표정요소";
    t_interior: "Interior orientation", "내부표정요소";
    c_errors(n) [photo = n "photo" "photos"]: "Standard errors with {n} {photo}", "사진 {n}매의 표준오차";
    c_improvement(d): "Improvement at {d} m", "{d} m에서의 향상률";
    c_mixed: "Standard errors of mixed distances", "여러 거리를 섞은 망의 표준오차";
    c_pairwise: "Errors with 3 photos: pair by pair and bundle", "사진 3매의 오차: 모델 쌍과 광속조정";
    c_distortion: "Radial distortion", "방사왜곡";
    c_distortion_error: "Radial distortion, ours minus planted", "방사왜곡, 여기 − 심은 값";
    c_way(axis, photo): "{axis} of photo {photo} over the iterations", "사진 {photo}의 {axis} 수렴";
}

// Axes, columns, lines, figures
texts! {
    photo: "photo", "사진";
    point: "point", "점";
    points: "points", "점";
    photos: "photos", "사진";
    count: "compared", "비교한 수";
    found: "found", "검출한 수";
    overlap_type: "type (overlap)", "유형(중복도)";
    standard_error: "standard error", "표준오차";
    rms_error: "rms error", "RMS 오차";
    improvement: "improvement", "향상률";
    distance: "distance", "거리";
    observations: "observations m", "관측수 m";
    unknowns: "unknowns n", "미지수 n";
    equations: "equations", "방정식";
    datum: "datum", "기준계";
    parameters: "additional parameters", "부가매개변수";
    relative: "relative accuracy", "상대정확도";
    relative_column: "relative accuracy 1 :", "상대정확도 1 :";
    method: "method", "방법";
    largest: "largest", "최대";
    mark: "mark", "지표";
    kind: "transformation", "변환";
    parameter: "parameter", "계수";
    value: "value", "값";
    radius: "radius", "반지름";
    distortion: "distortion", "왜곡";
    table: "table", "보정표";
    polynomial: "polynomial", "다항식";
    residual: "residual", "잔차";
    corrected: "lens corrected", "왜곡 보정";
    bundle_sigma0: "σ₀ of the bundle", "광속조정 σ₀";
    marks_sigma0: "σ₀ of the marks", "지표 σ₀";
    planted: "planted (the paper's)", "심은 값(논문 값)";
    error: "error", "오차";
    element: "element", "요소";
    dlt: "DLT", "DLT";
    bundle: "bundle", "광속조정";
    statistic: "statistic", "통계량";
    total: "total", "전체";
    iteration: "iteration", "반복";
    iterations: "iterations until nothing moves by 0.1 mm", "0.1 mm 안으로 수렴한 반복 수";
    check_points: "check points", "검사점";
    base_fall(base): "fall of M₀ with B/D from 0.2 to {base}", "B/D 0.2 → {base}에서 M₀ 감소";
    fall_of(what): "fall of {what}", "{what} 감소";
    m0_mean(n) [photo = n "photo" "photos"]: "{n} {photo} against 2, mean fall of M₀", "2매 대비 {n}매, M₀ 평균 감소";
    m0_up_to(n) [photo = n "photo" "photos"]: "{n} {photo} against 2, greatest fall of M₀", "2매 대비 {n}매, M₀ 최대 감소";
    m0_least: "least fall of M₀ over types", "유형별 M₀ 최소 감소";
    m0_greatest: "greatest fall of M₀ over types", "유형별 M₀ 최대 감소";
    monte_carlo(axis): "Monte Carlo scatter against S{axis}", "몬테카를로 산포와 S{axis}의 차";
    residual_axis(axis): "residual {axis}", "잔차 {axis}";
    rms_sigma(axis): "rms σ{axis}", "RMS σ{axis}";
    error_of(what): "error of {what} in its σ", "{what} 오차, σ 단위";
    gain_of(axis): "gain of the free network in {axis}", "자유망 향상률 {axis}";
    centre_rms: "centre errors, rms", "중심 오차 RMS";
    distortion_sigma0: "σ₀ of the polynomial", "다항식 σ₀";
    pair_unaided: "pairs, best fit, one draw", "모델 쌍, 최적합, 한 번";
    pair_draws: "pairs, axes parallel, 4 draws", "모델 쌍, 광축 평행, 네 번";
    bundle_draws: "bundle, 4 draws", "광속조정, 네 번";
    pair_of(axis): "pairs {axis}", "모델 쌍 {axis}";
    bundle_of(axis): "bundle {axis}", "광속조정 {axis}";
    pair_rms_draws: "pairs rms, 4 draws", "모델 쌍 RMS, 네 번";
    bundle_rms_draws: "bundle rms, 4 draws", "광속조정 RMS, 네 번";
    pair_unaided_rms: "pairs best fit rms", "모델 쌍 최적합 RMS";
    pair_unaided_rms_draws: "pairs best fit rms, 4 draws", "모델 쌍 최적합 RMS, 네 번";
    reduced_of(what): "{what}, photos left out", "{what}, 사진을 뺀 뒤";
}

// Assumptions, as sentences
texts! {
    a_base_line_centre: "The base line's centre faces the mean of the points: the paper does not print where it lies.",
        "기선의 중심은 점들의 평균을 마주 봅니다. 논문에는 기선의 위치가 없습니다.";
    a_overall_means: "\"About 15, 35 and up to 50 %\" is read over the distances of the paper's figures 4-6 to 4-9, 1.4 to 4.0 m: the means of 3 and 4 photos, the greatest fall with 5. At 7.0 m more photos gain more.",
        "\"약 15, 35, 50 %까지\"는 논문 그림 4-6~4-9의 거리 1.4~4.0 m에서 읽었습니다. 3매와 4매는 평균, 5매는 최대 감소입니다. 7.0 m에서는 사진을 더할 때의 향상이 더 큽니다.";
    a_pairwise: "The paper's models formed pair by pair had random errors that did not follow the distance. With random image errors alone ours grow with the distance like the bundle's: the method by itself is not irregular. It becomes so where the second orientation of a shallow object is taken for the first.",
        "논문에서 공면조건 모델 쌍의 오차는 거리와 무관하게 불규칙했습니다. 우연오차만 있으면 여기서는 광속조정처럼 거리에 따라 커집니다. 방법 자체는 불규칙하지 않습니다. 깊이가 얕은 피사체의 두 번째 상호표정 해를 택하면 불규칙해집니다.";
    a_readings: "The readings are made up: plates of the usual kind, read to the σ above. The paper prints none.",
        "읽음값은 여기서 만들었습니다. 보통의 건판을 위의 σ로 읽은 것입니다. 논문에는 없습니다.";
    a_distortion: "The distortion table is made up, of the usual size: the paper shows it as a drawing only.",
        "왜곡 보정표는 보통 크기로 만들었습니다. 논문에는 그림만 있습니다.";
    a_film_along(v): "The film shrank to {v} along its run.", "필름은 길이 방향으로 {v}배 수축했습니다.";
    a_film_across(v): "The film shrank to {v} across it.", "필름은 폭 방향으로 {v}배 수축했습니다.";
    a_station_distance(v, paper): "Stations {v} mm away; the paper says about {paper} mm, from where this camera sees 1.9 × 1.3 m of the 2.0 × 1.5 m field and fewer targets than the 100 to 119 a photo of its table 1. Farther away it sees more of them, though still not as many.",
        "촬영점은 {v} mm 거리입니다. 논문의 약 {paper} mm에서는 이 카메라가 2.0 × 1.5 m 가운데 1.9 × 1.3 m만 보여 표 1의 사진당 100~119점에 미치지 못합니다. 더 멀리서는 늘지만 그만큼은 아닙니다.";
    a_field_depth(v): "Targets at depths over {v} mm: the paper says \"three-dimensional\" and no more.", "표적의 깊이 범위는 {v} mm입니다. 논문에는 \"3차원\"이라고만 적혀 있습니다.";
    a_station_directions: "Stations on an arc at ±10°, ±30°, ±50°: the paper draws them without figures.", "촬영점은 ±10°, ±30°, ±50°의 호 위에 있습니다. 논문에는 수치 없이 그림만 있습니다.";
    a_psf(v): "Lens blur of {v} px (standard deviation).", "렌즈 번짐은 {v} px(표준편차)입니다.";
    a_pixel_noise(v): "Pixel noise of {v} % of full scale, constant and by photons.", "화소 잡음은 최댓값의 {v} %입니다(일정 성분과 광자 성분).";
    a_centroid: "Intensity centroids are adjusted, the paper's better weighting; other centres can be chosen above.", "논문에서 더 나은 밝기값 경중률의 도심을 조정합니다. 위에서 다른 중심을 고를 수 있습니다.";
    a_base_distance(v, paper): "Base line {v} mm from the wall; the paper says about {paper} mm, from where this camera sees 3.7 × 2.5 m of the 6.3 × 3.5 m wall. At 7.4 m network I has the paper's 374 equations, but the photos of II miss the upper and lower rows. Standard errors grow with the distance.",
        "기선은 벽에서 {v} mm 떨어져 있습니다. 논문의 약 {paper} mm에서는 이 카메라가 6.3 × 3.5 m 벽의 3.7 × 2.5 m만 봅니다. 7.4 m이면 망 I의 방정식이 논문과 같은 374개이지만 망 II의 사진이 위아래 줄을 보지 못합니다. 표준오차는 거리에 따라 커집니다.";
    a_outer(v): "Outer stations of network I {v} mm from the middle: not printed. From 5 000 to 7 500 mm the order III, I, II in depth is the same.",
        "망 I의 바깥 촬영점은 중앙에서 {v} mm 떨어져 있습니다. 논문에 없습니다. 5 000~7 500 mm에서 깊이 정확도의 순서 III, I, II는 같습니다.";
    a_relief(v): "Targets on pillars stand {v} mm before the wall: not printed.", "기둥의 표적은 벽보다 {v} mm 앞에 있습니다. 논문에 없습니다.";
    a_observed: "The additional parameters are observed with the sigmas of the first experiment's calibration; in the paper they are unknown. The table has both: in network II four control points then add to the calibration what the free datum does without.",
        "부가매개변수는 첫 실험의 검정 표준오차를 지닌 관측값입니다. 논문에서는 미지수입니다. 표에 둘 다 있습니다. 미지수로 두면 망 II에서는 기준점 네 개가 검정을 도와 자유망이 불리해집니다.";
    a_principal_distance(v): "Principal distance {v} mm: the paper prints none. The image scale is then about 1 : 1 100.", "주점거리는 {v} mm입니다. 논문에 없습니다. 사진축척은 약 1 : 1 100입니다.";
    a_survey(v): "Surveyed coordinates are off by {v} mm (1σ): better than the total station's 2 mm + 2 ppm, as within one room and from one set-up.",
        "측량 좌표의 오차는 {v} mm(1σ)입니다. 한 실내에서 한 번 설치하여 재므로 토털스테이션의 2 mm + 2 ppm보다 작게 두었습니다.";
    a_diameter(v): "Targets of {v} mm.", "표적 지름은 {v} mm입니다.";
    a_control_places: "The 65 control points lie on two planes through the check points: the paper prints the 15 check points only.",
        "기준점 65개는 검사점을 지나는 두 평면 위에 있습니다. 논문에는 검사점 15개만 있습니다.";
}
