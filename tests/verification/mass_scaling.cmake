# Mass scaling of explicit steps: added masses, increments and frequencies in closed form, and the same bits as denser matter.
verification_cases(mass_scaling 180 tiny_element element_at_a_spring kinds vibration heavier_matter weight keeps_its_increment steps_and_ranks
                   with_linkages)
