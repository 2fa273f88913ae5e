"""Mapper, Modeller, Localizer: state + scan -> state. Command line, jobs and live sessions run these."""
