//! The words of the page in its languages: one catalogue, sorted by place.

/// A language of the page.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Language {
    /// English.
    #[default]
    English,
    /// Chinese, in simplified letters.
    Chinese,
}

impl Language {
    /// Its tag, as HTML writes it.
    #[must_use]
    pub fn tag(self) -> &'static str {
        match self {
            Self::English => "en",
            Self::Chinese => "zh-Hans",
        }
    }

    /// A phrase in this language. English stands for itself, and for what has no translation, such as names.
    #[must_use]
    pub fn say(self, english: &str) -> &str {
        match self {
            Self::English => english,
            Self::Chinese => CATALOGUE.iter().find(|(e, _)| *e == english).map_or(english, |(_, c)| c),
        }
    }

    /// The name of a measure: its words, and the side and number that may follow them.
    #[must_use]
    pub fn measure(self, english: &str) -> String {
        let known = |words: &str| self == Self::English || self.say(words) != words;
        match english.rsplit_once(' ') {
            Some((words, last)) if !known(english) => {
                let space = if self == Self::Chinese { "" } else { " " };
                format!("{}{space}{}", self.measure(words), self.say(last))
            }
            _ => self.say(english).to_owned(),
        }
    }

    /// Meaning and remedy of the findings of a code; the remedy may be empty. `None` where the finding's own words say
    /// it, as in English.
    #[must_use]
    pub fn finding(self, code: &str) -> Option<[&'static str; 2]> {
        match self {
            Self::English => None,
            Self::Chinese => super::chinese::of_code(code),
        }
    }

    /// A sentence with numbers: `{0}`, `{1}` stand for the values.
    #[must_use]
    pub fn fill(self, english: &str, values: &[String]) -> String {
        let text = self.say(english).to_owned();
        values.iter().enumerate().fold(text, |t, (k, v)| t.replace(&format!("{{{k}}}"), v))
    }
}

/// English and Chinese.
const CATALOGUE: &[(&str, &str)] = &[
    // Verdict.
    ("Passed.", "合格。"),
    ("Not passed.", "不合格。"),
    ("Failed.", "失败。"),
    ("Not draped.", "未模拟。"),
    ("Not certified.", "未检验。"),
    (
        "This shape was edited or moved after its drape and was not draped again, so nothing certifies it.",
        "此形状在模拟之后被编辑或移动，未重新模拟，因此没有检验结论。",
    ),
    (
        "This shape was read from a file and was not draped here, so nothing certifies it.",
        "此形状读自文件，未在此模拟，因此没有检验结论。",
    ),
    ("Its flattened pieces are within all tolerances that were asked for.", "展平后的裁片均在所要求的公差之内。"),
    ("Its flattened pieces have {0} changes over their tolerance.", "展平后的裁片有 {0} 处变化超出公差。"),
    ("Its pieces were flattened; no tolerance was asked for.", "裁片已展平，未要求公差。"),
    (
        "The garment came to rest, its seams and darts are closed, nothing crosses, and the largest strain is {0} % of \
         what the fabric bears ({1} % are allowed).",
        "服装已静止，缝线和省道均已闭合，没有穿插，最大应变为面料允许值的 {0} %（上限 {1} %）。",
    ),
    (
        "There is no drape and so no certificate; this page shows the garment as far as it was made.",
        "没有悬垂结果，因此没有检验结论；本页显示已完成的部分。",
    ),
    ("nothing holds {0}", "{0} 没有任何支撑"),
    ("the garment did not come to rest", "服装未达到静止"),
    ("a gate of the certificate did not hold", "有一项检验指标未通过"),
    ("forces of {0} of a particle's weight are left, {1} are allowed", "剩余受力为质点重量的 {0}，允许 {1}"),
    (
        "the cloth is stretched to {0} % of what the fabric bears, {1} % are allowed",
        "布料拉伸达到面料允许值的 {0} %，允许 {1} %",
    ),
    ("the largest strain is {0} %, {1} % are allowed", "最大应变为 {0} %，允许 {1} %"),
    ("the garment slid down by {0} mm, {1} mm are allowed", "服装下滑 {0} mm，允许 {1} mm"),
    ("a seam is open by {0} mm, {1} mm are allowed", "缝线张开 {0} mm，允许 {1} mm"),
    ("a dart is open by {0} mm, {1} mm are allowed", "省道张开 {0} mm，允许 {1} mm"),
    ("the cloth crosses itself at {0} places", "布料自身有 {0} 处穿插"),
    ("cloth and body cross at {0} places", "布料与人体有 {0} 处穿插"),
    ("cloth lies {0} mm deep in the body", "布料陷入人体 {0} mm"),
    ("in motion the largest strain is {0} %, {1} % are allowed", "运动中最大应变为 {0} %，允许 {1} %"),
    ("in motion {0} % of the energy come from nothing, {1} % are allowed", "运动中有 {0} % 的能量凭空产生，允许 {1} %"),
    ("a free fall is off by {0} % of its length, {1} % are allowed", "自由下落偏差为落程的 {0} %，允许 {1} %"),
    // Facts.
    ("Size", "尺码"),
    ("Fabric", "面料"),
    ("Body", "人体"),
    ("Pattern", "纸样"),
    ("{0}, {1} g/m², {2} mm thick", "{0}，{1} g/m²，厚 {2} mm"),
    ("pieces: {0}, seams: {1}, darts: {2}", "裁片 {0}，缝线 {1}，省道 {2}"),
    ("girth, mm", "围度，mm"),
    ("body", "人体"),
    ("pattern", "纸样"),
    ("ease", "放松量"),
    ("bust", "胸围"),
    ("under bust", "下胸围"),
    ("waist", "腰围"),
    ("hip", "臀围"),
    ("thigh left", "左大腿围"),
    ("thigh right", "右大腿围"),
    ("The garment is {0} mm long and ends {1} mm above the floor.", "服装全长 {0} mm，下端离地 {1} mm。"),
    ("The lowest edge is {0} mm long.", "最低的边长 {0} mm。"),
    // View.
    ("{0}, from the front and from the back", "{0}，正面和背面"),
    (
        "{0} in 3D. Arrow keys turn it, plus and minus change its size, 1 to 5 are fixed views.",
        "{0} 三维视图。方向键旋转，加减号缩放，1 至 5 为固定视角。",
    ),
    ("Front", "正面"),
    ("Back", "背面"),
    ("Left", "左侧"),
    ("Right", "右侧"),
    ("colours", "颜色"),
    ("cloth", "面料"),
    ("garment", "成衣"),
    ("from the flat pattern to the garment", "从平面纸样到成衣"),
    ("cut at height", "按高度剖切"),
    ("section", "剖面"),
    (
        "Section at {height} mm, seen from above. All cloth: {length} mm.",
        "高度 {height} mm 处的剖面，俯视。布料总长 {length} mm。",
    ),
    (
        "Click a piece, a seam or a dart, here, in the drawing or in a table.",
        "点击裁片、缝线或省道：在此处、纸样图或表格中均可。",
    ),
    ("show the place", "显示位置"),
    ("strain along warp", "经向应变"),
    ("strain along weft", "纬向应变"),
    ("distance to the body", "与人体的距离"),
    ("bending", "弯曲"),
    ("strain along bias", "斜向应变"),
    ("tension of the cloth", "布料张力"),
    ("surface strain", "表面应变"),
    ("gap", "间隙"),
    ("tension", "张力"),
    ("wrinkles", "褶皱"),
    ("cross-section", "截面"),
    ("colourway", "配色"),
    ("as sewn", "原色"),
    ("play", "播放"),
    ("pause", "暂停"),
    ("moment of the motion", "动作时刻"),
    ("Points of measure", "测量点"),
    ("measure", "部位"),
    ("expected mm", "目标 mm"),
    ("tolerance mm", "公差 mm"),
    ("off mm", "偏差 mm"),
    ("pressure on the body", "对人体的压力"),
    ("piece", "裁片"),
    ("seam", "缝线"),
    ("dart", "省道"),
    ("{0} {1}: {2} mm on {3} mm", "{0} {1}：{2} mm 对 {3} mm"),
    // Findings.
    ("Findings", "检查结果"),
    ("There are no warnings.", "没有警告。"),
    ("notes: {0}", "说明：{0} 条"),
    ("error", "错误"),
    ("warning", "警告"),
    ("Remedy", "处理办法"),
    // Drawings and tables.
    (
        "Pieces with the numbers of their edges. A click picks a piece, a seam or a dart.",
        "裁片及其边的编号。点击可选中裁片、缝线或省道。",
    ),
    ("Measures and ease", "尺寸与放松量"),
    (
        "Girths in level planes, below the armholes where sleeves hang on the cloth. Pattern: the cloth at rest. \
         Worn: along every fold of the draped cloth; the tape bridges folds. Ease: pattern less body.",
        "水平面内的围度；该高度与袖子相连时，在袖窿以下测量。纸样：未受力的布料。\
         穿着：沿悬垂布料的每个褶皱；软尺跨过褶皱。放松量：纸样减人体。",
    ),
    ("at", "部位"),
    ("height mm", "高度 mm"),
    ("body mm", "人体 mm"),
    ("pattern mm", "纸样 mm"),
    ("worn mm", "穿着 mm"),
    ("tape mm", "软尺 mm"),
    ("ease mm", "放松量 mm"),
    ("ease %", "放松量 %"),
    ("Lengths", "长度"),
    (
        "Sleeves and centre lines: along the straight grain from their highest point, without cuffs and bands. Seams: \
         the side that is not eased. Free edges are hems, necklines and openings; their height is a mean.",
        "袖长和中线：从最高点沿直丝缕，不含袖头和腰头。缝线：未归拢的一边。自由边指下摆、领口和开口；高度为平均值。",
    ),
    ("Pieces, flat and worn", "裁片：平面与穿着"),
    (
        "Length along the grain and width across it, through the middle of the piece: what the cloth gives or shrinks \
         when it is worn.",
        "通过裁片中点，沿丝缕的长度和垂直丝缕的宽度：穿着时布料的伸缩。",
    ),
    ("along mm", "长 mm"),
    ("across mm", "宽 mm"),
    ("change mm", "变化 mm"),
    ("change %", "变化 %"),
    ("shoulder length", "肩长"),
    ("sleeve length", "袖长"),
    ("armhole girth", "袖窿围"),
    ("sleeve seam", "袖底缝"),
    ("neckline seam", "领口缝"),
    ("side seam", "侧缝"),
    ("inseam", "内裆缝"),
    ("outseam", "外侧缝"),
    ("front rise", "前裆"),
    ("back rise", "后裆"),
    ("front length", "前中长"),
    ("back length", "后中长"),
    ("skirt length front", "前裙长"),
    ("skirt length back", "后裙长"),
    ("what", "项目"),
    ("length mm", "长度 mm"),
    ("garment, top to bottom", "服装全长"),
    ("free edge", "自由边"),
    ("hem", "下摆"),
    ("leg hem", "裤脚口"),
    ("sleeve hem", "袖口"),
    ("armhole", "袖窿"),
    ("neckline", "领口"),
    ("waist edge", "腰口"),
    ("top edge", "上口"),
    ("front edge", "门襟边"),
    ("collar edge", "领边"),
    ("hood edge", "帽边"),
    ("pocket edge", "袋边"),
    ("lining edge", "里布边"),
    ("facing edge", "贴边"),
    ("left", "左"),
    ("right", "右"),
    ("pieces", "裁片"),
    ("Pieces", "裁片表"),
    ("triangles", "三角形"),
    ("outline mm", "轮廓 mm"),
    ("original cm²", "面积 cm²"),
    ("Flattened pieces", "展平后的裁片"),
    (
        "One line a piece: what is over its tolerance, and the largest changes of every kind. Sewn edges and notches \
         beside their partner, and the legs of darts, are always judged; all else where a tolerance was given.",
        "每片一行：超出公差之处，以及各类的最大变化。缝合边与剪口相对其缝合对边、省道两边始终检查；其余仅在给出公差时检查。",
    ),
    ("passes", "合格"),
    ("what fails", "不合格之处"),
    ("largest changes", "最大变化"),
    ("Edges", "边"),
    ("edge", "边"),
    ("original mm", "原长 mm"),
    ("Darts", "省道"),
    ("width mm", "省量 mm"),
    ("leg a mm", "省边 a mm"),
    ("leg b mm", "省边 b mm"),
    ("Seams", "缝线"),
    ("Both sides of every seam; ease is side a less side b.", "每条缝线的两边；吃势为 a 边减 b 边。"),
    ("kind", "种类"),
    ("stitches", "缝点"),
    ("Strain of the cloth", "布料应变"),
    ("from", "起始"),
    ("direction", "方向"),
    ("smallest", "最小"),
    ("mean", "平均"),
    ("largest", "最大"),
    ("unit", "单位"),
    ("Certificate of the drape", "悬垂检验"),
    ("figure", "指标"),
    ("value", "数值"),
    ("limit", "限值"),
    ("Effects", "模拟效应"),
    ("effect", "效应"),
    ("on", "开启"),
    ("rule", "规则"),
    ("evidence", "依据"),
    ("How it was made", "制作过程"),
    ("stage", "步骤"),
    ("revision", "修订"),
    ("parameters", "参数"),
    ("Inputs", "输入文件"),
    ("file", "文件"),
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_phrase_stands_once_and_keeps_its_values() {
        for (k, (english, chinese)) in CATALOGUE.iter().enumerate() {
            assert!(CATALOGUE[..k].iter().all(|(e, _)| e != english), "{english}");
            for mark in ["{0}", "{1}", "{2}", "{3}", "{height}", "{length}"] {
                assert_eq!(english.contains(mark), chinese.contains(mark), "{english}");
            }
        }
        assert_eq!(
            Language::Chinese.fill("the cloth crosses itself at {0} places", &["3".into()]),
            "布料自身有 3 处穿插"
        );
        assert_eq!(Language::Chinese.say("FRONT"), "FRONT");
    }
}
