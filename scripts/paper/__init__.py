"""What scripts/paper_tables.py and scripts/ablations.py are made of."""
