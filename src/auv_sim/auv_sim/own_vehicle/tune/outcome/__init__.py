"""What a search leaves behind for its reader: words and a picture."""
