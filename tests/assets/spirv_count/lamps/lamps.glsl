// Counted by the template.
