"""The programs and examples of the controls' manuals, one table for each control: EXAMPLES."""
