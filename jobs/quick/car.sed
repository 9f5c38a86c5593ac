# The car of jobs/car on coarse tyres, rigid but for its tyres, springs and rear axle, for 150 ms: until its front wheels are over.
s|^fidelity = .*|fidelity = "rigid"|
s|^mesh_size = .*|mesh_size = 100.0|
s|^frames = .*|frames = 30|
s|^stable_increment = .*|stable_increment = 0.004|
s|^duration = 400.0|duration = 150.0|
