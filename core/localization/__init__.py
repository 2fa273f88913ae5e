"""Where the robot is (paper, Sect. 4): the method as written, the pose-grid default, particles."""
