//! A machine and a frame to be measured with.

use framepath::axes::Axes;
use framepath::frame::{ActiveFrame, Operation, OperationList, ToolLength, WorkOffset};
use framepath::machine::{Coordinates, Machine, TableTilting, TableTiltingParameters, TiltAxis};
use nalgebra::Vector3;

/// Shifted, turned and scaled.
pub fn frame() -> ActiveFrame {
    let mut list = OperationList::new();
    list.set(&Operation::translate(Vector3::new(10.0, 20.0, 30.0)).unwrap());
    list.append(&Operation::rotate_zyx(Vector3::new(30.0, 20.0, 10.0)).unwrap())
        .unwrap();
    list.append(&Operation::scale(Vector3::new(1.5, 1.5, 1.5)).unwrap())
        .unwrap();
    let work = WorkOffset::new(Axes::repeat(50.0), Axes::zeros(), 15.0).unwrap();
    let tool = Axes::from([0.0, 0.0, 80.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let folded = list.fold().unwrap();
    ActiveFrame::new(&folded, [false; 6], &work, &tool, ToolLength::Machine).unwrap()
}

/// A tilting table with the tool centre point on.
pub fn table(tilt: TiltAxis, coordinates: &[u8]) -> Machine {
    let coordinates = Coordinates::parse(coordinates).unwrap();
    let mut machine = TableTilting::new(tilt, coordinates).unwrap();
    let parameters = TableTiltingParameters {
        rotation_point: Vector3::new(1.0, 2.0, 3.0),
        offset: Vector3::new(0.0, 4.0, 5.0),
        tool_offset: 80.0,
        tool_centre_point: true,
        ..TableTiltingParameters::default()
    };
    machine.set_parameters(parameters).unwrap();
    Machine::TableTilting(machine)
}
