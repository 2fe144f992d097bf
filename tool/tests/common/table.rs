//! A machine of framekins whose joints have limits of their own.

use crate::bench::Bench;

/// Half a turn of C.
pub const TURN: &str = "G21 G61 F6000\nG1 C180\nM2\n";

/// A table that turns about C 50 mm beside the start, with the tool centre point: 60 degrees/s for A and C, for joint 0
/// 40 mm/s. A machine unit has so many mm.
pub fn table(bench: &Bench, units: &str, millimetres: f64) {
    let mut ini = format!(
        "[EMC]\nMACHINE = table\n[EMCMOT]\nSERVO_PERIOD = 1000000\n[TRAJ]\nLINEAR_UNITS = {units}\nANGULAR_UNITS = degree\n[HAL]\n\
         HALFILE = table.hal\n[KINS]\nKINEMATICS = framekins coordinates=XYZAC machine=xyzac\n"
    );
    let mut hal = format!(
        "loadrt [KINS]KINEMATICS\nsetp framekins.tool-centre-point 1\nsetp framekins.x-rot-point {}\n",
        -50.0 / millimetres
    );
    for (joint, letter) in "XYZAC".chars().enumerate() {
        let linear = joint < 3;
        let unit = if linear { millimetres } else { 1.0 };
        let [velocity, acceleration] = if linear {
            [100.0, 1000.0]
        } else {
            [60.0, 600.0]
        };
        let limits = |velocity: f64| {
            format!(
                "MAX_VELOCITY = {}\nMAX_ACCELERATION = {}\n",
                velocity / unit,
                acceleration / unit
            )
        };
        let slower = if joint == 0 { 40.0 } else { velocity };
        ini += &format!("[AXIS_{letter}]\n{}", limits(velocity));
        ini += &format!("[JOINT_{joint}]\n{}", limits(slower));
        for limit in ["velocity", "acceleration"] {
            let key = limit.to_uppercase();
            hal += &format!("setp blendtp.joint.{joint}.max-{limit} [JOINT_{joint}]MAX_{key}\n");
        }
    }
    bench.write("table.ini", &ini);
    bench.write("table.hal", &hal);
}
