//! Tests of `lines.rs`.

use super::RecordedReader;

#[test]
fn line_ends_of_any_kind_count() {
    for end in ["\n", "\r\n"] {
        let text = ["a,b", "1,2", "", "# no row", "3,4", "\"5", "x\",6", "7,8"].join(end);
        let (watched, mut lines) = RecordedReader::new(text.as_bytes());
        let reader = csv::ReaderBuilder::new().comment(Some(b'#')).buffer_capacity(3).from_reader(watched);
        let records = reader.into_records();
        let found: Vec<u64> =
            records.map(|record| lines.record_line(record.unwrap().position().unwrap().byte())).collect();
        assert_eq!(found, [2, 5, 6, 8], "{end:?}");
    }
}
