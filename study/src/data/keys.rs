//! Keys of a map.

abbe_spec::tables! {
    FILE: ["the file"], ["data", "joints", "inputs"];
    FORMS: ["the file"], ["point", "difference", "target", "pose", "instrument"];
    STANDS: ["the file"], ["station", "placement", "place", "accept", "record"];
    DATA: ["[data]"], ["title", "description", "reference", "uncertainty", "angle_uncertainty", "base", "group", "direction", "time", "station", "placement", "setup"];
    CHANNEL: ["[joints.NAME]", "[inputs.NAME]"], ["column", "unit", "sign", "zero", "value"];
    FROM_ROWS: ["[inputs.NAME]"], ["approach", "gravity_moment", "frame"];

    POINT: ["[point]"], ["columns", "unit"];
    DIFFERENCE: ["[difference]"], ["target", "difference", "unit"];
    TARGET: ["[[target]]"], ["name", "columns", "unit", "position"];
    ANY_INSTRUMENT: ["[[instrument]]"], ["name", "kind"];
    INSTRUMENT: ["[[instrument]]"], ["column", "columns", "unit", "target", "targets", "at", "direction", "mirror", "zero", "radius", "nominal_radius", "range"];
    EVERY_INSTRUMENT: ["[[instrument]]"], ["setup", "uncertainty"];
    POSE: ["[pose]"], ["position", "unit"];
    TURN: ["[pose]"], ["quaternion", "matrix", "euler", "rotation_vector"];
    QUATERNION: ["[pose.quaternion]"], ["columns", "order"];
    EULER: ["[pose.euler]"], ["columns", "order", "unit"];
    ROTATION_VECTOR: ["[pose.rotation_vector]"], ["columns", "unit"];

    STATION: ["[[station]]"], ["name", "position", "quaternion", "covariance"];
    PLACE: ["[[place]]"], ["name", "position", "direction", "zero", "covariance"];
    ACCEPT: ["[accept]"], ["mean", "rms", "p95", "max"];
    RECORD: ["[record]"], ["date", "operator", "machine", "serial", "instrument", "certificate"];
    PLACEMENT: ["[placement]"], ["targets", "position", "quaternion", "covariance"];
}
