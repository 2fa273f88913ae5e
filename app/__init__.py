"""The product: command line, server, storage, jobs, viewer."""
