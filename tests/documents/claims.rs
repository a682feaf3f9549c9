//! What papers claim: the table of the document is that of the record, and the record is of the claims that there are.

use moment_shadows_lab::claims::record::{Record, Verdict};
use moment_shadows_lab::claims::table::CLAIMS;
use moment_shadows_lab::command::claims::record;

use crate::read;

#[test]
fn the_table_is_that_of_the_record() {
    let text = std::fs::read_to_string(record()).unwrap();
    let record: Record = serde_json::from_str(&text).unwrap();
    let document = read("docs/claims.md").replace("\r\n", "\n");
    let table = record.to_string();
    assert!(document.contains(&table), "docs/claims.md lacks\n{table}");
    // Every claim has been measured as it stands.
    let recorded = record.rows.iter().map(|row| {
        let [one, other] = &row.techniques;
        (
            row.source.as_str(),
            row.says.as_str(),
            one.as_str(),
            other.as_str(),
            row.at_most,
        )
    });
    let claims = CLAIMS
        .iter()
        .map(|it| (it.source, it.says, it.one, it.other, it.at_most));
    assert!(
        recorded.eq(claims),
        "run `moment-shadows-lab claims --out claims --update`"
    );
    for row in &record.rows {
        assert_eq!(row.verdict, Verdict::of(row.holds), "{}", row.says);
        assert!(row.verdict != Verdict::NotMeasured, "{}", row.says);
    }
    // The sum that the document begins with.
    let count = |verdict| {
        record
            .rows
            .iter()
            .filter(|row| row.verdict == verdict)
            .count()
    };
    let [reproduced, qualified, contradicted] = [
        Verdict::Reproduced,
        Verdict::Qualified,
        Verdict::Contradicted,
    ]
    .map(count);
    let all = record.rows.len();
    let said = format!(
        "Of {all} comparisons {reproduced} are reproduced, {qualified} qualified and {contradicted} contradicted."
    );
    assert!(document.contains(&said), "docs/claims.md lacks '{said}'");
    let scenes = record.scenes.join("`, `");
    let [views, map] = [record.views, record.map];
    let said = format!("`{scenes}`, {views} views each");
    assert!(document.contains(&said), "docs/claims.md lacks '{said}'");
    let said = format!("a map of {map} x {map} texels");
    assert!(document.contains(&said), "docs/claims.md lacks '{said}'");
}
