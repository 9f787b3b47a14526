# Doxygen reads each page through this. The pages lie side by side in the HTML site, so links to pictures lose their
# folders above, links to pages lose their places, and what is no page is named without a link.
s#\]\((\.\./)+([^) ]+\.(png|svg))\)#](\2)#g
s#\]\(([^) ]+\.md)\#[^) ]*\)#](\1)#g
s#\[([^]]+)\]\(([A-Za-z0-9_./-]*/[A-Za-z0-9_-]+|[A-Z]+|[A-Za-z0-9_./-]+\.(h|hpp|json|toml|ts))\)#\1#g
