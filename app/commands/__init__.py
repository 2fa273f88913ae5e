"""The commands of `echorooms`, one a file. Heavy imports happen when a command runs."""
