# The tyre of jobs/car in fewer sectors, its section in fewer elements.
s|^title = .*|title = "165/65R14 of the car, coarse"|
s|^sectors = .*|sectors = 36|
/^\[section.belt\]/,/^plies/ s|^elements = .*|elements = 4|
/^\[section.shoulder\]/,/^plies/ s|^elements = .*|elements = 2|
/^\[section.sidewall\]/,/^plies/ s|^elements = .*|elements = 3|
