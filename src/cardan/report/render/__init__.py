"""What a report says, written in a form: HTML, PDF, workbook, plain data; single pages and figures of it."""
