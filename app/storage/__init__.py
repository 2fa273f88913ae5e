"""What lasts: an SQLite index and files under one data folder, behind repositories."""
