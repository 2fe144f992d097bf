//! How fast `framepath filter` is, and how much memory it takes: a program of plain motions of 100 MB, as
//! a CAM system writes it, in each dialect.

use clap::Parser;
use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use framepath_tool::dialects::Dialect;
use framepath_tool::filter::{FilterArguments, filter};
use std::fmt::Write as _;
use std::io::{BufWriter, Write};
use std::path::Path;
use std::time::Duration;

/// The length of the program, bytes.
const LENGTH: usize = 100_000_000;

#[derive(Parser)]
struct Line {
    #[command(flatten)]
    arguments: FilterArguments,
}

/// Writes the program: a surface in rows, three axes a block.
fn write_program(path: &Path) -> std::io::Result<()> {
    let mut file = BufWriter::new(std::fs::File::create(path)?);
    let mut line = String::from("G17 G90\nG0 X0 Y0 Z5\nG1 Z0 F2000\n");
    let mut written = 0;
    let mut number = 0_u32;
    while written < LENGTH {
        let (row, column) = (number / 4000, number % 4000);
        let x = f64::from(column) * 0.05;
        let y = f64::from(row) * 0.1;
        let z = -2.0 + (x * 0.11).sin() + (y * 0.07).cos();
        let _ = writeln!(line, "N{number} G1 X{x:.3} Y{y:.3} Z{z:.4}");
        file.write_all(line.as_bytes())?;
        written += line.len();
        line.clear();
        number += 1;
    }
    file.write_all(b"M30\n")?;
    file.flush()
}

fn arguments(dialect: &str, path: &Path) -> FilterArguments {
    let path = path.display().to_string();
    let words = ["filter", "--dialect", dialect, "--feed", "1000", &path];
    Line::parse_from(words).arguments
}

/// The most memory that this process has held at once so far, MB.
fn most_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status
        .lines()
        .find_map(|line| line.strip_prefix("VmHWM:"))?;
    let kilobytes: u64 = line.trim().trim_end_matches("kB").trim().parse().ok()?;
    Some(kilobytes / 1000)
}

fn plain_programs(criterion: &mut Criterion) {
    let folder = tempfile::tempdir().expect("a folder for the program");
    let path = folder.path().join("part.nc");
    write_program(&path).expect("room for the program");
    let mut group = criterion.benchmark_group("filter, plain motions");
    group.throughput(Throughput::Bytes(LENGTH as u64));
    group.sample_size(10);
    group.warm_up_time(Duration::from_millis(100));
    group.measurement_time(Duration::from_secs(10));
    for dialect in Dialect::ALL.iter().map(|dialect| dialect.name()) {
        let arguments = arguments(dialect, &path);
        group.bench_function(dialect, |bencher| {
            bencher.iter(|| {
                let translated = filter(&arguments, &mut |_| {}).expect("a program that is right");
                translated.write_to(&mut std::io::sink()).expect("nowhere")
            });
        });
    }
    group.finish();
    if let Some(most) = most_memory() {
        println!("most memory held at once: {most} MB");
    }
}

criterion_group!(benches, plain_programs);
criterion_main!(benches);
