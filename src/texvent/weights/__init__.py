"""Published network weights: fetched by name, checked, converted to safetensors."""
