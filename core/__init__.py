"""The science of EchoRooms: sonar mapping, segmentation, topology and localization."""
