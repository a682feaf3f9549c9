//! Claims with what was found, as they are kept and told.

use core::fmt::{self, Write};

use serde::{Deserialize, Serialize};

use super::evidence::{Case, Evidence};
use super::table::Claim;

/// All claims, judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Record {
    /// The adapter and its driver.
    pub adapter: String,
    /// Scenes of hard shadows.
    pub scenes: Vec<String>,
    /// Views of each, radii of filters, and texels per side of the map.
    pub views: u32,
    /// Radii of filters in texels.
    pub radii: Vec<u32>,
    /// Texels per side of the map.
    pub map: u32,
    /// The claims.
    pub rows: Vec<Judgement>,
}

/// A claim, judged.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// What it is about.
    pub topic: String,
    /// The paper, and where in it.
    pub source: String,
    /// What it says.
    pub says: String,
    /// What is compared.
    pub techniques: [String; 2],
    /// The smallest profile whose devices make both maps; none where that is not about maps in storages.
    pub profile: Option<String>,
    /// Which figure, and its unit.
    pub figure: [String; 2],
    /// It holds where the first figure is at most so many times the second.
    pub at_most: f64,
    /// Places where it holds, and all.
    pub holds: [usize; 2],
    /// The geometric means of both figures; of powers, the means.
    pub means: [f64; 2],
    /// Where the first figure is largest as a part of the second, and that part.
    pub worst: (String, f64),
    /// What follows.
    pub verdict: Verdict,
}

/// What becomes of a claim.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Verdict {
    /// It holds everywhere.
    Reproduced,
    /// It holds in at least half of all places.
    Qualified,
    /// It holds in fewer.
    Contradicted,
    /// Nothing was measured.
    NotMeasured,
}

impl Verdict {
    /// The verdict on what holds in so many places of so many.
    #[must_use]
    pub fn of([holds, all]: [usize; 2]) -> Self {
        match holds {
            _ if all == 0 => Self::NotMeasured,
            _ if holds == all => Self::Reproduced,
            _ if 2 * holds >= all => Self::Qualified,
            _ => Self::Contradicted,
        }
    }

    /// The verdict as tables have it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Reproduced => "reproduced",
            Self::Qualified => "qualified",
            Self::Contradicted => "**contradicted**",
            Self::NotMeasured => "not measured",
        }
    }
}

impl Judgement {
    /// Judges a claim by what was measured.
    pub(super) fn of(claim: &Claim, evidence: &Evidence, profile: Option<String>) -> Self {
        let cases = evidence.cases(claim);
        let part = |case: &Case| case.figures[0] / case.figures[1];
        let is_held = |case: &&Case| case.figures[0] <= claim.at_most * case.figures[1];
        let holds = [cases.iter().filter(is_held).count(), cases.len()];
        let mean = |index: usize| {
            let figures = || cases.iter().map(|case| case.figures[index]);
            let count = cases.len().max(1) as f64;
            // Powers may be below zero, and other figures zero at a place.
            match claim.figure.told()[1] {
                "as power" => figures().sum::<f64>() / count,
                _ => (figures().map(|it| it.max(1e-9).ln()).sum::<f64>() / count).exp(),
            }
        };
        let worst = (cases.iter()).max_by(|one, other| part(one).total_cmp(&part(other)));
        Self {
            topic: claim.topic.to_owned(),
            source: claim.source.to_owned(),
            says: claim.says.to_owned(),
            techniques: [claim.one, claim.other].map(str::to_owned),
            profile,
            figure: claim.figure.told().map(str::to_owned),
            at_most: claim.at_most,
            holds,
            means: [mean(0), mean(1)],
            worst: worst.map_or((String::new(), 0.0), |case| {
                (case.place.clone(), part(case))
            }),
            verdict: Verdict::of(holds),
        }
    }

    fn row(&self) -> String {
        let [one, other] = &self.techniques;
        let [figure, unit] = &self.figure;
        let times = match self.at_most {
            1.0 => String::new(),
            at_most => format!("{at_most} times "),
        };
        let profile = (self.profile.as_ref()).map_or(String::new(), |it| format!(" (`{it}`)"));
        let means = self.means.map(|mean| match unit.as_str() {
            "%" => format!("{mean:.2}"),
            "ms" => format!("{mean:.0}"),
            _ => format!("{mean:.1}"),
        });
        let [holds, all] = self.holds;
        let (place, part) = &self.worst;
        let worst = match holds < all {
            true => format!("{part:.2} times: {place}"),
            false => String::new(),
        };
        format!(
            "| {}: {} | {figure} of `{one}` at most {times}that of `{other}`{profile} | {holds} of {all} | {} and {} {unit} | {worst} | {} |",
            self.source,
            self.says,
            means[0],
            means[1],
            self.verdict.name(),
        )
    }
}

impl fmt::Display for Record {
    /// A table in Markdown for each topic.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mut topic = "";
        let mut text = String::new();
        for row in &self.rows {
            if row.topic != topic {
                topic = &row.topic;
                let head = "| who says what | it holds where | holds in | means | least of all | |\n|---|---|---|---|---|---|";
                writeln!(text, "\n## {topic}\n\n{head}")?;
            }
            writeln!(text, "{}", row.row())?;
        }
        f.write_str(text.trim_start())
    }
}
